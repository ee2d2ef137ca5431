// SPDX-License-Identifier: MIT
// The bend of a sample is twice its distance from the mean of its two neighbors. A step between two
// uniform surfaces thus counts in full. Without a step, contrast is the bend. Seams locate steps,
// so lower weights apply to contrast beside them.
#include "refine/pixel_contrast.h"

// Weights of color differences and of bends beside a seam, and of contrast in a pixel with a seam.
#define STEP_WEIGHT  0.5f
#define BEND_WEIGHT  0.25f
#define PIXEL_WEIGHT 0.5f

static float larger(float a, float b)
{
    return a > b ? a : b;
}

// Returns twice the distance of a sample from the weighted mean of its neighbors.
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

// Returns the color difference of samples on different surfaces.
static float step(const SampleData *at, const SampleData *other)
{
    return at->signature == other->signature ? 0 : seam_difference(at, other);
}

float contrast_past_seams(float contrast)
{
    return PIXEL_WEIGHT * contrast;
}

// Computes the contrasts of a line's cells. Each sample beyond the line is twice as far from the
// next cell as cells are from each other.
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

// Raises the contrasts of a line's cells to the contrasts along the line.
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

// The area of a cell of each level, in pixels.
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
    return (level == 0 ? PIXEL_WEIGHT * CONTRAST_OUTLINE_WEIGHT : STEP_WEIGHT) * parts[level] *
           most;
}

void contrast_keep(CellGroup *group)
{
    CellContrast contrast[GROUP_CELLS] = {0};
    for (uint32_t i = 0; i < GROUP_SIDE; i++) {
        add_line(group, i * GROUP_SIDE, 1, contrast);
        add_line(group, i, GROUP_SIDE, contrast);
    }
    for (uint32_t i = 0; i < GROUP_CELLS; i++) {
        contrast[i].value *= parts[group->level];
        group->contrasts[i] = contrast_kept(contrast[i]);
    }
    for (CellSide side = 0; side < SIDE_COUNT; side++)
        group->across[side] =
            contrast_across(group, side, &group->beyond[side], group->beyond_levels[side]);
}
