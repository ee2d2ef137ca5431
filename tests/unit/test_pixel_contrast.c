// SPDX-License-Identifier: MIT
// Tests that the vectorized contrasts of pixels equal the contrasts computed one by one. Tests the
// neighbors of cells in a refined picture, and its largest size.
#include "refine/pixel_contrast.h"
#include "unit/cmocka_all.h"
#include "unit/random.h"

#include <math.h>
#include <string.h>

static void fill(RefineTree *tree)
{
    uint64_t random = 1;
    for (uint32_t y = 0; y < tree->height; y++)
        for (uint32_t x = 0; x < tree->width; x++) {
            SampleData *sample = &tree->pixels[refine_tree_place(tree, x, y)];
            for (int channel = 0; channel < 3; channel++)
                sample->color[channel] = (float)random_unit(&random);
            sample->signature = random_below(&random, 2);
        }
}

static const SampleData *sample_at(const RefineTree *tree, uint32_t x, uint32_t y)
{
    return &tree->pixels[refine_tree_place(tree, x, y)];
}

static float bend(const SampleData *before, const SampleData *at, const SampleData *after)
{
    float most = 0;
    for (int channel = 0; channel < 3; channel++) {
        const float line = 0.5f * before->color[channel] + 0.5f * after->color[channel];
        most = fmaxf(most, 2 * fabsf(at->color[channel] - line));
    }
    return most;
}

static float step(const SampleData *at, const SampleData *other)
{
    return at->signature == other->signature ? 0 : seam_difference(at, other);
}

// stride is {1, 0} for the horizontal axis, {0, 1} for the vertical axis.
static void add_axis(const RefineTree *tree, const uint32_t place[2], const uint32_t stride[2],
                     float *steps, float *bends)
{
    const uint32_t x = place[0], y = place[1];
    const SampleData *at = sample_at(tree, x, y), *before = NULL, *after = NULL;
    if (x >= stride[0] && y >= stride[1])
        before = sample_at(tree, x - stride[0], y - stride[1]);
    if (x + stride[0] < tree->width && y + stride[1] < tree->height)
        after = sample_at(tree, x + stride[0], y + stride[1]);
    *steps = before == NULL ? *steps : fmaxf(*steps, step(at, before));
    *steps = after == NULL ? *steps : fmaxf(*steps, step(at, after));
    if (before != NULL && after != NULL)
        *bends = fmaxf(*bends, bend(before, at, after));
}

static void check_pixel(const RefineTree *tree, const PixelContrasts *contrasts, uint32_t x,
                        uint32_t y)
{
    float steps = 0, bends = 0;
    const uint32_t place[2] = {x, y}, across[2] = {1, 0}, down[2] = {0, 1};
    add_axis(tree, place, across, &steps, &bends);
    add_axis(tree, place, down, &steps, &bends);
    const CellContrast kept = pixel_contrast(contrasts, x, y);
    const float value = fmaxf(CONTRAST_OUTLINE_WEIGHT * steps, bends);
    assert_memory_equal(&kept.value, &value, sizeof value);
    assert_int_equal(kept.is_step, steps > 0);
}

static void check_size(uint32_t width, uint32_t height)
{
    Error error = {0};
    FREED_BY(refine_tree_free) RefineTree tree;
    FREED_BY(pixel_contrasts_free) PixelContrasts contrasts;
    assert_true(refine_tree_make(&tree, width, height, &error));
    fill(&tree);
    assert_true(pixel_contrasts_make(&contrasts, &tree, NULL, &error));
    for (uint32_t y = 0; y < height; y++)
        for (uint32_t x = 0; x < width; x++)
            check_pixel(&tree, &contrasts, x, y);
}

TEST(contrasts_of_strips_are_those_of_single_pixels)
{
    check_size(1, 1);
    check_size(1, 7);
    check_size(5, 1);
    check_size(64, 16);
    check_size(65, 17);
    check_size(199, 35);
}

TEST(a_step_between_equal_colors_is_none)
{
    Error error = {0};
    FREED_BY(refine_tree_free) RefineTree tree;
    FREED_BY(pixel_contrasts_free) PixelContrasts contrasts;
    assert_true(refine_tree_make(&tree, 2, 1, &error));
    memset(tree.pixels, 0, refine_tree_places(&tree) * sizeof *tree.pixels);
    tree.pixels[1].signature = 1;
    assert_true(pixel_contrasts_make(&contrasts, &tree, NULL, &error));
    assert_false(pixel_contrast(&contrasts, 0, 0).is_step);
}

// Subdivides one of two pixels, and its right middle cell. All samples are taken.
static void make_tree(RefineTree *tree)
{
    Error error = {0};
    assert_true(refine_tree_make(tree, 2, 1, &error));
    assert_true(refine_tree_cut_pixel(tree, 0, 0, &error));
    assert_true(refine_tree_cut_cell(tree, 1, 5, &error));
    tree->traced = 3;
}

TEST(a_cell_beyond_the_pixel_is_the_pixel_beside)
{
    FREED_BY(refine_tree_free) RefineTree tree;
    CellName name;
    make_tree(&tree);
    assert_true(refine_tree_neighbor(&tree, &tree.groups.data[2], SIDE_RIGHT, &name));
    assert_int_equal(name.group, 0);
    assert_int_equal(name.cell, 1);
}

TEST(cells_without_their_samples_are_no_neighbors_yet)
{
    FREED_BY(refine_tree_free) RefineTree tree;
    CellName name;
    Error error = {0};
    make_tree(&tree);
    assert_true(refine_tree_cut_pixel(&tree, 1, 0, &error));
    assert_false(refine_tree_neighbor(&tree, &tree.groups.data[2], SIDE_RIGHT, &name));
    tree.traced = 4;
    assert_true(refine_tree_neighbor(&tree, &tree.groups.data[2], SIDE_RIGHT, &name));
    assert_int_equal(name.group, 3);
    assert_int_equal(name.cell, 3);
}

// In 32 bits, the number of pixels wraps around to 0.
TEST(a_picture_past_the_numbers_of_its_pixels_is_refused)
{
    RefineTree tree;
    Error error = {0};
    assert_false(refine_tree_make(&tree, 65536, 65536, &error));
    assert_string_equal(error.text, "a picture of 65536 x 65536 pixels is too large to be refined");
    assert_null(tree.pixels);
}
