// SPDX-License-Identifier: MIT
// Cutting a cell changed its color by so much for its contrast; cutting those that are left would
// change theirs by as much for theirs.  That ratio is the scene's own, level by level, and errors
// of cells are as good as independent of each other.
#include "render/cell_sums.h"

#include "render/contrast.h"

#include <math.h>
#include <stdlib.h>

#define ROWS_OF_TASK   16
#define GROUPS_OF_TASK 512

// The squared ratio where fewer cells were cut than tell it: somewhat above what scenes have, which
// is 0.035 to 0.06 for pixels, where contrast counts four times at outlines, and 0.1 to 0.17 below.
#define FEW_CUTS     64
#define PIXEL_SQUARE (0.07 * 0.07)
#define CELL_SQUARE  (0.2 * 0.2)

typedef struct {
    const RefineTree *tree;
    CellSums *parts; // of each task
    uint32_t row_tasks;
} Summing;

static uint32_t tasks_of(size_t whole, uint32_t part)
{
    return (uint32_t)((whole + part - 1) / part);
}

static size_t end_of(uint32_t task, uint32_t part, size_t whole)
{
    const size_t end = (size_t)(task + 1) * part;
    return end < whole ? end : whole;
}

static uint32_t bin_of(float contrast)
{
    const double place = contrast > 0 ? 4 * log2((double)CONTRAST_MOST / (double)contrast) : 1e9;
    return place <= 0 ? 0 : place < CONTRAST_BINS - 1 ? (uint32_t)place : CONTRAST_BINS - 1;
}

static void add_left(CellSums *sums, float contrast, uint32_t level)
{
    sums->left[level] += (double)contrast * (double)contrast;
    if (level < REFINE_LEVELS)
        sums->counts[bin_of(contrast)]++;
}

static void add_cut(CellSums *sums, float contrast, uint32_t level, const float change[3])
{
    const double part = pow(9, -(double)level);
    sums->cut[level] += (double)contrast * (double)contrast;
    sums->cuts[level]++;
    for (int channel = 0; channel < 3; channel++)
        sums->changed[level] += pow(part * (double)change[channel], 2) / 3;
}

static void add_cell(const RefineTree *tree, const SampleData *sample, float contrast,
                     uint32_t group, uint32_t level, CellSums *sums)
{
    float change[3];
    if (group == 0) {
        add_left(sums, contrast, level);
        return;
    }
    refine_tree_mean(tree, group, change);
    for (int channel = 0; channel < 3; channel++)
        change[channel] -= sample->color[channel];
    add_cut(sums, contrast, level, change);
}

static void sum_rows(const RefineTree *tree, uint32_t task, CellSums *sums)
{
    const uint32_t end = (uint32_t)end_of(task, ROWS_OF_TASK, tree->height);
    for (uint32_t y = task * ROWS_OF_TASK; y < end; y++)
        for (uint32_t x = 0; x < tree->width; x++)
            add_cell(tree, &tree->pixels[refine_tree_place(tree, x, y)],
                     contrast_of_pixel(tree, x, y), tree->pixel_groups[(size_t)y * tree->width + x],
                     0, sums);
}

static void sum_groups(const RefineTree *tree, uint32_t task, CellSums *sums)
{
    const size_t end = end_of(task, GROUPS_OF_TASK, tree->groups.count - 1);
    for (size_t i = (size_t)task * GROUPS_OF_TASK; i < end; i++) {
        const CellGroup *group = &tree->groups.data[i + 1];
        float contrast[GROUP_CELLS];
        contrast_of_group(group, contrast);
        for (uint32_t cell = 0; cell < GROUP_CELLS; cell++)
            add_cell(tree, &group->cells[cell], contrast[cell], group->groups[cell], group->level,
                     sums);
    }
}

static void sum_task(void *context, uint32_t task, uint32_t worker)
{
    (void)worker;
    const Summing *summing = context;
    if (task < summing->row_tasks)
        sum_rows(summing->tree, task, &summing->parts[task]);
    else
        sum_groups(summing->tree, task - summing->row_tasks, &summing->parts[task]);
}

static void add_part(CellSums *sums, const CellSums *part)
{
    for (uint32_t level = 0; level <= REFINE_LEVELS; level++) {
        sums->cut[level] += part->cut[level];
        sums->left[level] += part->left[level];
        sums->changed[level] += part->changed[level];
        sums->cuts[level] += part->cuts[level];
    }
    for (uint32_t bin = 0; bin < CONTRAST_BINS; bin++)
        sums->counts[bin] += part->counts[bin];
}

bool cell_sums_make(CellSums *sums, const Adaptive *adaptive, Error *error)
{
    const RefineTree *tree = &adaptive->tree;
    Summing summing = {.tree = tree, .row_tasks = tasks_of(tree->height, ROWS_OF_TASK)};
    const uint32_t tasks = summing.row_tasks + tasks_of(tree->groups.count - 1, GROUPS_OF_TASK);
    *sums = (CellSums){.pixels = (double)tree->width * tree->height};
    summing.parts = memory_zeroed(tasks, sizeof *summing.parts, error);
    if (summing.parts == NULL)
        return false;
    crew_run(adaptive->crew, tasks, sum_task, &summing);
    for (uint32_t task = 0; task < tasks; task++)
        add_part(sums, &summing.parts[task]);
    free(summing.parts);
    return true;
}

// What a square of contrast changes, squared.
static double square_of_ratio(const CellSums *sums, uint32_t level)
{
    if (sums->cuts[level] >= FEW_CUTS && sums->cut[level] > 0)
        return sums->changed[level] / sums->cut[level];
    return level == 0 ? PIXEL_SQUARE : CELL_SQUARE;
}

double cell_sums_error(const CellSums *sums)
{
    double squares = 0;
    for (uint32_t level = 0; level <= REFINE_LEVELS; level++)
        squares += square_of_ratio(sums, level) * sums->left[level];
    return sqrt(squares / sums->pixels);
}

float cell_sums_threshold(const CellSums *sums, double cells)
{
    double above = 0;
    for (uint32_t bin = 0; bin < CONTRAST_BINS; bin++) {
        above += (double)sums->counts[bin];
        if (above > cells)
            return (float)(CONTRAST_MOST * exp2(-(double)bin / 4));
    }
    return 0;
}
