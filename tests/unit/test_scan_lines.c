// SPDX-License-Identifier: MIT
// Tests the colors of pixels and the places of their samples, with edges at known positions.
#include "refine/scan_lines.h"
#include "unit/cmocka_all.h"

#include <stdlib.h>

// A shape returns the color at a place of the pixel.
typedef float Shape(uint32_t place, uint32_t line, uint32_t number);

static SampleData sample_of(Shape *shape, uint32_t place, uint32_t line, uint32_t number)
{
    const float color = shape(place, line, number);
    return (SampleData){.color = {color, color, color}};
}

// Opens all new lines with samples at both ends, in the middle and at `extra`.
static void open_lines(ScanLines *scan, Shape *shape, uint32_t number, uint32_t extra)
{
    Error error;
    while (scan->opened < scan->lines.count) {
        LineSample samples[4];
        uint32_t count = 0;
        for (uint32_t place = 0; place < REFINE_GRID; place++)
            if (place % (REFINE_GRID / 2) == 0 || place == extra)
                samples[count++] = (LineSample){
                    place, sample_of(shape, place, scan->lines.data[scan->opened].middle, number)};
        assert_true(scan_lines_open(scan, samples, count, &error));
    }
}

// Splits gaps until none is open. Returns the number of samples.
static uint32_t close_gaps(ScanLines *scan, Shape *shape, uint32_t number)
{
    Error error;
    uint32_t samples = 0;
    while (scan->gaps.count > 0) {
        SampleData *taken = calloc(scan->gaps.count, sizeof *taken);
        assert_non_null(taken);
        for (size_t i = 0; i < scan->gaps.count; i++) {
            const Gap *gap = &scan->gaps.data[i];
            taken[i] =
                sample_of(shape, scan_gap_place(gap), scan->lines.data[gap->line].middle, number);
        }
        samples += (uint32_t)scan->gaps.count;
        assert_true(scan_lines_split_gaps(scan, taken, &error));
        free(taken);
    }
    return samples;
}

// Returns the lines of one pixel with these probes.
static ScanLines lines_of(const Probe *probes, uint32_t count)
{
    Error error;
    ScanLines scan = {.probes = probes, .threshold = 1e-4f, .bend = 1e-3f};
    const RefinedPixel pixel = {.end = count};
    assert_true(scan_lines_make(&scan, &error));
    assert_true(scan_lines_add(&scan, &pixel, &error));
    return scan;
}

static double color_of(const ScanLines *scan)
{
    float color[3];
    assert_true(scan_lines_color(scan, &scan->pixels.data[1], color));
    assert_true(color[0] == color[1] && color[0] == color[2]);
    return (double)color[0];
}

// Divides the pixel between two lines of the shape. The lines are one band beyond the pixel's
// borders.
static void divide(ScanLines *scan, Shape *shape, uint32_t number)
{
    Error error;
    LineMean beyond[2] = {{.middle = -14}, {.middle = 94}};
    for (int i = 0; i < 2; i++)
        for (uint32_t place = 0; place < REFINE_GRID; place++)
            for (int channel = 0; channel < 3; channel++)
                beyond[i].color[channel] +=
                    (double)shape(place, (uint32_t)beyond[i].middle, number) / REFINE_GRID;
    assert_true(scan_lines_divide(scan, 1, beyond, &error));
}

static float step(uint32_t place, uint32_t line, uint32_t number)
{
    (void)line;
    return place < number ? 0.25f : 0.75f;
}

TEST(samples_find_a_step_wherever_it_is)
{
    for (uint32_t place = 1; place < REFINE_GRID; place++) {
        FREED_BY(scan_lines_free) ScanLines scan = lines_of(NULL, 0);
        open_lines(&scan, step, place, 0);
        assert_true(close_gaps(&scan, step, place) <= 3 * 6);
        const double expected = (0.25 * place + 0.75 * (REFINE_GRID - place)) / REFINE_GRID;
        assert_true(fabs(color_of(&scan) - expected) < 1e-6);
    }
}

static float three_surfaces(uint32_t place, uint32_t line, uint32_t number)
{
    (void)line;
    return place < number ? 0.25f : place < number + 12 ? 1 : 0.5f;
}

TEST(a_third_surface_in_a_gap_is_found_by_its_middle)
{
    FREED_BY(scan_lines_free) ScanLines scan = lines_of(NULL, 0);
    open_lines(&scan, three_surfaces, 53, 0);
    close_gaps(&scan, three_surfaces, 53);
    const double expected = (0.25 * 53 + 12 + 0.5 * 16) / REFINE_GRID;
    assert_true(fabs(color_of(&scan) - expected) < 1e-6);
}

static float gradient(uint32_t place, uint32_t line, uint32_t number)
{
    (void)line;
    return (float)(place + number) / 200;
}

TEST(a_gradient_has_its_exact_color)
{
    FREED_BY(scan_lines_free) ScanLines scan = lines_of(NULL, 0);
    open_lines(&scan, gradient, 7, 0);
    close_gaps(&scan, gradient, 7);
    assert_true(fabs(color_of(&scan) - 47.0 / 200) < 1e-6);
}

// The first `number` + `line` / 2 places are dark.
static float slanted(uint32_t place, uint32_t line, uint32_t number)
{
    return (int)(2 * place) < (int)(2 * number) + (int)line ? 0 : 1;
}

TEST(three_lines_suffice_for_a_straight_edge)
{
    FREED_BY(scan_lines_free) ScanLines scan = lines_of(NULL, 0);
    open_lines(&scan, slanted, 20, 0);
    close_gaps(&scan, slanted, 20);
    divide(&scan, slanted, 20);
    assert_int_equal(scan.lines.count - 1, 3);
    assert_true(fabs(color_of(&scan) - (REFINE_GRID - 40.25) / REFINE_GRID) < 0.005);
}

// A bright corner, from `number` on along both axes.
static float corner(uint32_t place, uint32_t line, uint32_t number)
{
    return place >= number && (int)line >= (int)number ? 1 : 0;
}

TEST(more_lines_are_added_at_a_corner)
{
    for (uint32_t place = 5; place < 80; place += 5) {
        FREED_BY(scan_lines_free) ScanLines scan = lines_of(NULL, 0);
        for (int level = 0; level < REFINE_LEVELS; level++) {
            open_lines(&scan, corner, place, 0);
            close_gaps(&scan, corner, place);
            divide(&scan, corner, place);
        }
        const double side = (double)(REFINE_GRID - place) / REFINE_GRID;
        assert_true(scan.opened - 1 > 3);
        assert_true(fabs(color_of(&scan) - side * side) < 0.01);
    }
}

TEST(pixels_with_a_line_without_samples_have_no_color)
{
    FREED_BY(scan_lines_free) ScanLines scan = lines_of(NULL, 0);
    float color[3];
    assert_false(scan_lines_color(&scan, &scan.pixels.data[1], color));
}

TEST(bands_are_divided_until_they_are_as_high_as_the_levels_of_probes)
{
    const Probe probes[] = {{0, 4, 30, 1}, {0, 46, 50, 2}, {0, 71, 3, 3}, {0, 67, 3, 0}};
    FREED_BY(scan_lines_free) ScanLines scan = lines_of(probes, 4);
    uint32_t area = 0, heights[REFINE_GRID] = {0};
    for (size_t i = 1; i < scan.lines.count; i++) {
        const ScanLine *line = &scan.lines.data[i];
        heights[line->middle] = line->height;
        area += line->height;
    }
    assert_int_equal(area, REFINE_GRID);
    assert_int_equal(heights[4], 9);
    assert_int_equal(heights[46], 3);
    assert_int_equal(heights[71], 1);
    assert_int_equal(heights[67], 3);
}
