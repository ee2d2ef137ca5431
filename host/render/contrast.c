// SPDX-License-Identifier: MIT
// Contrast is how far a sample lies off the line between the two beside it, doubled so that a step
// between two even surfaces counts as what it is; and where the surfaces differ no less than the
// difference itself.  In groups seams tell where steps lie, and contrast what they may have missed.
#include "render/contrast.h"

#include <math.h>
#include <string.h>

// Two pixels may agree in color by chance where an outline runs between them.
#define OUTLINE_WEIGHT 2

// Beside a seam, and in a pixel that has one.
#define STEP_WEIGHT  0.5f
#define BEND_WEIGHT  0.25f
#define PIXEL_WEIGHT 0.5f

static float larger(float a, float b)
{
    return a > b ? a : b;
}

// Off the line, where `before` weighs weight and `after` the rest.
static inline float bend(const SampleData *before, const SampleData *at, const SampleData *after,
                         float weight)
{
    float most = 0;
    for (int channel = 0; channel < 3; channel++) {
        const float line = weight * before->color[channel] + (1 - weight) * after->color[channel];
        most = larger(most, fabsf(at->color[channel] - line));
    }
    return 2 * most;
}

// Between samples that did not see the same.
static float step(const SampleData *at, const SampleData *other)
{
    float most = 0;
    if (at->signature == other->signature)
        return 0;
    for (int channel = 0; channel < 3; channel++)
        most = larger(most, fabsf(at->color[channel] - other->color[channel]));
    return most;
}

CellContrast contrast_of_pixel(const RefineTree *tree, uint32_t x, uint32_t y)
{
    const SampleData *pixels = tree->pixels, *at = &pixels[refine_tree_place(tree, x, y)];
    const bool is_left = x == 0, is_right = x + 1 == tree->width;
    const bool is_top = y == 0, is_bottom = y + 1 == tree->height;
    const SampleData *left = is_left ? at : &pixels[refine_tree_place(tree, x - 1, y)];
    const SampleData *right = is_right ? at : &pixels[refine_tree_place(tree, x + 1, y)];
    const SampleData *above = is_top ? at : &pixels[refine_tree_place(tree, x, y - 1)];
    const SampleData *below = is_bottom ? at : &pixels[refine_tree_place(tree, x, y + 1)];
    const float steps =
        larger(larger(step(at, left), step(at, right)), larger(step(at, above), step(at, below)));
    CellContrast contrast = {OUTLINE_WEIGHT * steps, steps > 0};
    if (!is_left && !is_right)
        contrast.value = larger(contrast.value, bend(left, at, right, 0.5f));
    if (!is_top && !is_bottom)
        contrast.value = larger(contrast.value, bend(above, at, below, 0.5f));
    return contrast;
}

// The three channels and the signature of a sample, which processors compare at once.
typedef float Channels __attribute__((vector_size(16)));
typedef int32_t Bits __attribute__((vector_size(16)));

static inline Channels channels_of(const SampleData *sample)
{
    Channels channels;
    memcpy(&channels, sample, sizeof channels);
    return channels;
}

static inline bool may_bend(Channels before, Channels at, Channels after, float threshold)
{
    const Channels bend = before + after - 2 * at;
    const Bits beyond = (bend > threshold) | (bend < -threshold);
    return (beyond[0] | beyond[1] | beyond[2]) != 0;
}

static inline bool saw_another(const SampleData *at, const SampleData *other)
{
    return at->signature != other->signature;
}

float contrast_past_seams(float contrast)
{
    return PIXEL_WEIGHT * contrast;
}

bool contrast_may_exceed(const RefineTree *tree, uint32_t x, uint32_t y, float threshold)
{
    if (x == 0 || y == 0 || x + 1 == tree->width || y + 1 == tree->height)
        return true;
    const SampleData *at = &tree->pixels[refine_tree_place(tree, x, y)];
    const SampleData *left = &tree->pixels[refine_tree_place(tree, x - 1, y)];
    const SampleData *right = &tree->pixels[refine_tree_place(tree, x + 1, y)];
    const SampleData *above = &tree->pixels[refine_tree_place(tree, x, y - 1)];
    const SampleData *below = &tree->pixels[refine_tree_place(tree, x, y + 1)];
    const float least = 0.999f * threshold; // the sums are rounded in another order
    return saw_another(at, left) || saw_another(at, right) || saw_another(at, above) ||
           saw_another(at, below) ||
           may_bend(channels_of(left), channels_of(at), channels_of(right), least) ||
           may_bend(channels_of(above), channels_of(at), channels_of(below), least);
}

// What lies beyond a line is twice as far away.
static void contrast_of_line(const SampleData *const line[LINE_SAMPLES], CellContrast found[])
{
    static const float weights[GROUP_SIDE] = {1 / 3.0f, 0.5f, 2 / 3.0f};
    bool is_step = seam_steps(line, 0);
    for (uint32_t i = 0; i < GROUP_SIDE; i++) {
        const SampleData *before = line[i], *at = line[i + 1], *after = line[i + 2];
        const bool was_step = is_step;
        const float sides = larger(step(at, before), step(at, after));
        const float bends = bend(before, at, after, weights[i]);
        is_step = seam_steps(line, i + 1);
        found[i].is_step = was_step || is_step;
        found[i].value =
            found[i].is_step ? larger(STEP_WEIGHT * sides, BEND_WEIGHT * bends) : bends;
    }
}

// Looks at cells `first` and those a stride apart.
static void add_line(const CellGroup *group, uint32_t first, uint32_t stride,
                     CellContrast contrast[GROUP_CELLS])
{
    const CellSide start = stride == 1 ? SIDE_LEFT : SIDE_ABOVE;
    const SampleData *cells = &group->cells[first];
    const SampleData *const line[LINE_SAMPLES] = {&group->beyond[start], cells, cells + stride,
                                                  cells + 2 * (size_t)stride,
                                                  &group->beyond[start + 1]};
    CellContrast found[GROUP_SIDE];
    contrast_of_line(line, found);
    for (uint32_t i = 0; i < GROUP_SIDE; i++) {
        CellContrast *cell = &contrast[first + i * stride];
        cell->value = larger(cell->value, found[i].value);
        cell->is_step = cell->is_step || found[i].is_step;
    }
}

// Of a pixel, by level.
static const float parts[REFINE_LEVELS + 1] = {1, 1 / 9.0f, 1 / 81.0f, 1 / 729.0f, 1 / 6561.0f};

float contrast_across(const CellGroup *group, CellSide side, const SampleData *other,
                      uint32_t level)
{
    static const uint32_t first[SIDE_COUNT] = {0, 2, 0, 6}, stride[SIDE_COUNT] = {3, 3, 1, 1};
    float most = 0;
    for (uint32_t i = 0; i < GROUP_SIDE; i++) {
        const SampleData *cell = &group->cells[first[side] + i * stride[side]];
        most = larger(most, step(cell, other));
    }
    return (level == 0 ? PIXEL_WEIGHT * OUTLINE_WEIGHT : STEP_WEIGHT) * parts[level] * most;
}

void contrast_of_group(const CellGroup *group, CellContrast contrast[GROUP_CELLS])
{
    memset(contrast, 0, GROUP_CELLS * sizeof *contrast);
    for (uint32_t i = 0; i < GROUP_SIDE; i++) {
        add_line(group, i * GROUP_SIDE, 1, contrast);
        add_line(group, i, GROUP_SIDE, contrast);
    }
    for (uint32_t i = 0; i < GROUP_CELLS; i++)
        contrast[i].value *= parts[group->level];
}
