// SPDX-License-Identifier: MIT
// Subdivides cells and sums their colors. Groups refer to each other by index, because the array
// moves when it grows. Colors are summed as integers in steps of 2^-32, as in kernels/render.cl.
#include "refine/refine_tree.h"

#include <stdlib.h>
#include <string.h>

bool refine_tree_make(RefineTree *tree, uint32_t width, uint32_t height, Error *error)
{
    *tree = (RefineTree){
        .width = width, .height = height, .columns = (width + PACKET_SIDE - 1) / PACKET_SIDE};
    const CellGroup none = {0};
    const Seam no_seam = {0};
    // Pixels and samples are counted in 32 bits.
    if ((uint64_t)width * height > REFINE_PIXELS_MOST)
        return error_set(error, "a picture of %u x %u pixels is too large to be refined", width,
                         height);
    // A stopped picture shows zeros where no sample was traced.
    tree->pixels = memory_zeroed(refine_tree_places(tree), sizeof *tree->pixels, error);
    tree->pixel_groups = memory_zeroed((size_t)width * height, sizeof *tree->pixel_groups, error);
    if (tree->pixels != NULL && tree->pixel_groups != NULL &&
        array_push(&tree->groups, none, error) && array_push(&tree->seams, no_seam, error))
        return true;
    refine_tree_free(tree);
    return false;
}

void refine_tree_free(RefineTree *tree)
{
    free(tree->pixels);
    free(tree->pixel_groups);
    free(tree->groups.data);
    free(tree->seams.data);
    *tree = (RefineTree){0};
}

void refine_tree_cell_place(const CellGroup *group, uint32_t cell, uint32_t place[2])
{
    const uint32_t side = refine_tree_cell_side(group->level);
    place[0] = group->x + cell % GROUP_SIDE * side - side;
    place[1] = group->y + cell / GROUP_SIDE * side - side;
}

bool refine_tree_find(const RefineTree *tree, const uint32_t place[2], CellName *name)
{
    const uint32_t column = place[0] / REFINE_GRID, row = place[1] / REFINE_GRID;
    if (column >= tree->width || row >= tree->height)
        return false;
    *name = (CellName){.cell = row * tree->width + column};
    uint32_t below = tree->pixel_groups[name->cell];
    while (below != 0) {
        const CellGroup *group = &tree->groups.data[below];
        const uint32_t side = refine_tree_cell_side(group->level), half = GROUP_SIDE * side / 2;
        name->group = below;
        name->level = group->level;
        name->cell =
            (place[1] + half - group->y) / side * GROUP_SIDE + (place[0] + half - group->x) / side;
        below = group->groups[name->cell];
    }
    return true;
}

const SampleData *refine_tree_sample(const RefineTree *tree, const CellName *name)
{
    if (name->group != 0)
        return &tree->groups.data[name->group].cells[name->cell];
    return &tree->pixels[refine_tree_place(tree, name->cell % tree->width,
                                           name->cell / tree->width)];
}

// Returns the link from a cell to the group that subdivides it.
static uint32_t *link_of(RefineTree *tree, const CellName *name)
{
    return name->group == 0 ? &tree->pixel_groups[name->cell]
                            : &tree->groups.data[name->group].groups[name->cell];
}

bool refine_tree_cut(RefineTree *tree, const CellName *name, Error *error)
{
    CellGroup group = {.level = name->level + 1};
    uint32_t place[2] = {name->cell % tree->width * REFINE_GRID + REFINE_GRID / 2,
                         name->cell / tree->width * REFINE_GRID + REFINE_GRID / 2};
    if (*link_of(tree, name) != 0)
        return true;
    if (tree->groups.count >= UINT32_MAX / 8)
        return error_set(error, "the picture is refined into too many cells");
    if (name->group != 0)
        refine_tree_cell_place(&tree->groups.data[name->group], name->cell, place);
    group.x = place[0];
    group.y = place[1];
    group.cells[GROUP_MIDDLE] = *refine_tree_sample(tree, name);
    if (!array_push(&tree->groups, group, error))
        return false;
    *link_of(tree, name) = (uint32_t)tree->groups.count - 1;
    return true;
}

void refine_tree_uncut(RefineTree *tree, uint32_t first)
{
    for (size_t i = 0; i < (size_t)tree->width * tree->height; i++)
        if (tree->pixel_groups[i] >= first)
            tree->pixel_groups[i] = 0;
    for (uint32_t number = 1; number < first; number++)
        for (uint32_t cell = 0; cell < GROUP_CELLS; cell++)
            if (tree->groups.data[number].groups[cell] >= first)
                tree->groups.data[number].groups[cell] = 0;
    tree->groups.count = first;
}

// Adds the colors of a group's cells, corrected by the group's seams. Instead of a subdivided cell,
// adds the group that subdivides the cell.
static void add_group(const RefineTree *tree, uint32_t number, ColorSum sum)
{
    const CellGroup *group = &tree->groups.data[number];
    const uint32_t side = refine_tree_cell_side(group->level);
    ColorSum sums[GROUP_CELLS];
    for (uint32_t cell = 0; cell < GROUP_CELLS; cell++)
        for (int channel = 0; channel < 3; channel++)
            sums[cell][channel] =
                2 * side * side * seam_color_steps(group->cells[cell].color[channel]);
    for (uint32_t seam = group->seams; seam != 0; seam = tree->seams.data[seam].next)
        seam_correct(&tree->seams.data[seam], group->cells, sums);
    for (uint32_t cell = 0; cell < GROUP_CELLS; cell++) {
        if (group->groups[cell] != 0)
            add_group(tree, group->groups[cell], sum);
        for (int channel = 0; channel < 3 && group->groups[cell] == 0; channel++)
            sum[channel] += sums[cell][channel];
    }
}

// Returns the number of samples that a group and the groups below it have added.
static uint32_t count_added(const RefineTree *tree, uint32_t number)
{
    const CellGroup *group = &tree->groups.data[number];
    uint32_t count = GROUP_CELLS - 1;
    for (uint32_t seam = group->seams; seam != 0; seam = tree->seams.data[seam].next)
        count += tree->seams.data[seam].samples;
    for (uint32_t cell = 0; cell < GROUP_CELLS; cell++)
        if (group->groups[cell] != 0)
            count += count_added(tree, group->groups[cell]);
    return count;
}

uint32_t refine_tree_count(const RefineTree *tree, uint32_t x, uint32_t y)
{
    const uint32_t group = tree->pixel_groups[(size_t)y * tree->width + x];
    return 1 + (group == 0 ? 0 : count_added(tree, group));
}

static void pixel_mean(const RefineTree *tree, uint32_t group, float mean[3])
{
    const uint64_t area = (uint64_t)REFINE_GRID * REFINE_GRID;
    ColorSum sum = {0};
    add_group(tree, group, sum);
    for (int channel = 0; channel < 3; channel++)
        mean[channel] = (float)((sum[channel] + area) / (2 * area)) * 0x1p-32f;
}

void refine_tree_store_row(const RefineTree *tree, uint32_t y, float (*colors)[3])
{
    for (uint32_t x = 0; x < tree->width; x++) {
        const uint32_t group = tree->pixel_groups[(size_t)y * tree->width + x];
        if (group != 0)
            pixel_mean(tree, group, colors[x]);
        else
            memcpy(colors[x], tree->pixels[refine_tree_place(tree, x, y)].color, sizeof colors[x]);
    }
}
