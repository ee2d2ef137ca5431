// SPDX-License-Identifier: MIT
// Colors are summed as integers in steps of 2^-32, as in kernels/render.cl. The unit of length of a
// line's sum is half a place, so that weights are integers. The first and the last sample of a line
// also stand for the rest of the line.
#include "refine/scan_lines.h"

#include <stdlib.h>
#include <string.h>

#define GRID_AREA ((float)(REFINE_GRID * REFINE_GRID))

bool scan_lines_make(ScanLines *scan, Error *error)
{
    const RefinedPixel no_pixel = {0};
    const ScanLine no_line = {0};
    scan->opened = 1;
    return array_push(&scan->pixels, no_pixel, error) && array_push(&scan->lines, no_line, error);
}

void scan_lines_free(ScanLines *scan)
{
    free(scan->pixels.data);
    free(scan->lines.data);
    free(scan->gaps.data);
    *scan = (ScanLines){0};
}

// Stores the height of the band around each line at the line's index, and 0 elsewhere. Divides the
// three bands of level 0 until every probe's line is the middle of a band of the probe's level.
static void band_heights(const ScanLines *scan, const RefinedPixel *pixel,
                         uint8_t heights[REFINE_GRID])
{
    for (uint32_t line = 0; line < REFINE_GRID; line++)
        heights[line] = line % band_height(0) == band_height(0) / 2 ? (uint8_t)band_height(0) : 0;
    for (uint32_t i = pixel->probes; i < pixel->end; i++)
        for (uint32_t level = 0; level < scan->probes[i].level; level++) {
            const uint32_t height = band_height(level), part = band_height(level + 1);
            const uint32_t middle = scan->probes[i].line / height * height + height / 2;
            if (heights[middle] == height)
                heights[middle] = heights[middle - part] = heights[middle + part] = (uint8_t)part;
        }
}

// Adds a line to the pixel's lines, which are in the order of their middles. The unused first
// element of scan->lines starts the list while it changes.
static bool add_line(ScanLines *scan, uint32_t number, uint32_t middle, uint32_t height,
                     Error *error)
{
    RefinedPixel *pixel = &scan->pixels.data[number];
    ScanLine *all = scan->lines.data;
    uint32_t before = 0;
    if (scan->lines.count >= UINT32_MAX / 8)
        return error_set(error, "the picture is refined into too many lines");
    all->next = pixel->lines;
    while (all[before].next != 0 && all[all[before].next].middle < middle)
        before = all[before].next;
    const ScanLine line = {.pixel = number,
                           .next = all[before].next,
                           .middle = (uint8_t)middle,
                           .height = (uint8_t)height};
    all[before].next = (uint32_t)scan->lines.count;
    pixel->lines = all->next;
    return array_push(&scan->lines, line, error);
}

bool scan_lines_add(ScanLines *scan, const RefinedPixel *pixel, Error *error)
{
    uint8_t heights[REFINE_GRID];
    bool ok = array_push(&scan->pixels, *pixel, error);
    band_heights(scan, pixel, heights);
    for (uint32_t line = 0; ok && line < REFINE_GRID; line++)
        ok = heights[line] == 0 ||
             add_line(scan, (uint32_t)scan->pixels.count - 1, line, heights[line], error);
    return ok;
}

static inline uint64_t color_steps(float color)
{
    return (uint64_t)(color * 0x1p32f);
}

static void add_color(ScanLine *line, const SampleData *sample, int64_t weight)
{
    for (int channel = 0; channel < 3; channel++)
        line->sum[channel] += (uint64_t)weight * color_steps(sample->color[channel]);
}

static void close_gap(ScanLines *scan, const Gap *gap)
{
    for (int end = 0; end < 2; end++)
        add_color(&scan->lines.data[gap->line], &gap->ends[end], gap->to - gap->from);
}

// Returns the error of the pixel's color if the change between the gap's ends may be anywhere in
// the gap. If several lines divide a band, their errors are independent, so the squares of their
// errors add up. The results are therefore increased: together, these lines count as much as one
// line in the whole band.
static float gap_error(const ScanLines *scan, const Gap *gap)
{
    const float height = (float)(scan->lines.data[gap->line].height * band_height(0));
    return sample_difference(&gap->ends[0], &gap->ends[1]) * (float)(gap->to - gap->from) *
           sqrtf(height) / GRID_AREA;
}

// Keeps the gap open if its error is large. Otherwise, closes the gap.
static bool keep_gap(ScanLines *scan, const Gap *gap, Error *error)
{
    if (gap->to - gap->from > 1 && gap_error(scan, gap) > scan->threshold)
        return array_push(&scan->gaps, *gap, error);
    close_gap(scan, gap);
    return true;
}

bool scan_lines_open(ScanLines *scan, const LineSample *samples, uint32_t count, Error *error)
{
    ScanLine *line = &scan->lines.data[scan->opened];
    bool ok = true;
    add_color(line, &samples[0].data, 2 * samples[0].place + 1);
    add_color(line, &samples[count - 1].data, 2 * (REFINE_GRID - 1 - samples[count - 1].place) + 1);
    for (uint32_t i = 0; ok && i + 1 < count; i++) {
        const Gap gap = {.ends = {samples[i].data, samples[i + 1].data},
                         .line = scan->opened,
                         .from = (uint8_t)samples[i].place,
                         .to = (uint8_t)samples[i + 1].place};
        ok = keep_gap(scan, &gap, error);
    }
    scan->opened++;
    return ok;
}

uint32_t scan_gap_place(const Gap *gap)
{
    return (gap->from + gap->to) / 2u;
}

bool scan_lines_split_gaps(ScanLines *scan, const SampleData *samples, Error *error)
{
    const size_t count = scan->gaps.count;
    bool ok = true;
    for (size_t i = 0; ok && i < count; i++) {
        Gap halves[2] = {scan->gaps.data[i], scan->gaps.data[i]};
        halves[0].to = halves[1].from = (uint8_t)scan_gap_place(&halves[0]);
        halves[0].ends[1] = halves[1].ends[0] = samples[i];
        scan->pixels.data[scan->lines.data[halves[0].line].pixel].samples++;
        ok = keep_gap(scan, &halves[0], error) && keep_gap(scan, &halves[1], error);
    }
    if (ok && count > 0) {
        scan->gaps.count -= count;
        memmove(scan->gaps.data, scan->gaps.data + count, scan->gaps.count * sizeof(Gap));
    }
    return ok;
}

void scan_lines_close_gaps(ScanLines *scan)
{
    for (size_t i = 0; i < scan->gaps.count; i++)
        close_gap(scan, &scan->gaps.data[i]);
    scan->gaps.count = 0;
}

LineMean scan_line_mean(const ScanLine *line)
{
    LineMean mean = {.middle = line->middle};
    for (int channel = 0; channel < 3; channel++)
        mean.color[channel] = (double)line->sum[channel] / (0x1p32 * 2 * REFINE_GRID);
    return mean;
}

static inline double larger(double one, double other)
{
    return one > other ? one : other;
}

// Returns the change in slope of the mean color at the second of three lines, mean[-1] to mean[1].
static double bend_at(const LineMean *mean)
{
    double bend = 0;
    for (int channel = 0; channel < 3; channel++) {
        const double before =
            (mean[0].color[channel] - mean[-1].color[channel]) / (mean[0].middle - mean[-1].middle);
        const double after =
            (mean[1].color[channel] - mean[0].color[channel]) / (mean[1].middle - mean[0].middle);
        bend = larger(bend, fabs(after - before));
    }
    return bend;
}

// Divides a line's band into three.
static bool divide_line(ScanLines *scan, uint32_t index, Error *error)
{
    ScanLine *line = &scan->lines.data[index];
    const uint32_t number = line->pixel, middle = line->middle, part = line->height / 3u;
    line->height = (uint8_t)part;
    return add_line(scan, number, middle - part, part, error) &&
           add_line(scan, number, middle + part, part, error);
}

bool scan_lines_divide(ScanLines *scan, uint32_t number, const LineMean beyond[2], Error *error)
{
    uint32_t lines[REFINE_GRID], count = 0;
    LineMean means[REFINE_GRID + 2];
    double bends[REFINE_GRID + 2] = {0};
    bool ok = true;
    for (uint32_t i = scan->pixels.data[number].lines; i != 0; i = scan->lines.data[i].next) {
        lines[count] = i;
        means[++count] = scan_line_mean(&scan->lines.data[i]);
    }
    means[0] = beyond[0];
    means[count + 1] = beyond[1];
    for (uint32_t i = 1; i <= count; i++)
        bends[i] = bend_at(&means[i]);
    for (uint32_t i = 0; ok && i < count; i++) {
        const uint32_t height = scan->lines.data[lines[i]].height;
        const double bend = larger(larger(bends[i], bends[i + 1]), bends[i + 2]);
        if (bend * height * height / (8 * REFINE_GRID) > (double)scan->bend && height > 1)
            ok = divide_line(scan, lines[i], error);
    }
    return ok;
}

bool scan_lines_color(const ScanLines *scan, const RefinedPixel *pixel, float color[3])
{
    const uint64_t area = (uint64_t)REFINE_GRID * REFINE_GRID;
    uint64_t sum[3] = {0};
    for (uint32_t i = pixel->lines; i != 0; i = scan->lines.data[i].next) {
        const ScanLine *line = &scan->lines.data[i];
        if (i >= scan->opened)
            return false;
        for (int channel = 0; channel < 3; channel++)
            sum[channel] += line->height * line->sum[channel];
    }
    for (int channel = 0; channel < 3; channel++)
        color[channel] = (float)((sum[channel] + area) / (2 * area)) * 0x1p-32f;
    return true;
}
