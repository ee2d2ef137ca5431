// SPDX-License-Identifier: MIT
// Groups refer to each other by number, since the array moves as it grows.  Means are sums of
// integers, as in render.cl, so that their bits depend on the samples alone.
#include "render/refine_tree.h"

#include <stdlib.h>
#include <string.h>

bool refine_tree_make(RefineTree *tree, uint32_t width, uint32_t height, Error *error)
{
    *tree = (RefineTree){
        .width = width, .height = height, .columns = (width + PACKET_SIDE - 1) / PACKET_SIDE};
    const CellGroup none = {0};
    tree->pixels = memory_raw(refine_tree_places(tree), sizeof *tree->pixels, error);
    tree->pixel_groups = memory_zeroed((size_t)width * height, sizeof *tree->pixel_groups, error);
    if (tree->pixels != NULL && tree->pixel_groups != NULL &&
        array_push(&tree->groups, none, error))
        return true;
    refine_tree_free(tree);
    return false;
}

void refine_tree_free(RefineTree *tree)
{
    free(tree->pixels);
    free(tree->pixel_groups);
    free(tree->groups.data);
    *tree = (RefineTree){0};
}

static bool append_group(RefineTree *tree, CellGroup **group, Error *error)
{
    const size_t count = tree->groups.count;
    if (count >= UINT32_MAX / 8)
        return error_set(error, "the picture is refined into too many cells");
    if (!array_reserve(&tree->groups.memory, &tree->groups.capacity, count + 1,
                       sizeof *tree->groups.data, error))
        return false;
    *group = &tree->groups.data[tree->groups.count++];
    return true;
}

bool refine_tree_cut_pixel(RefineTree *tree, uint32_t x, uint32_t y, Error *error)
{
    CellGroup *group = NULL;
    if (!append_group(tree, &group, error))
        return false;
    const uint32_t half = REFINE_GRID / 2, right = x + 1 < tree->width ? x + 1 : x;
    const uint32_t below = y + 1 < tree->height ? y + 1 : y;
    *group = (CellGroup){.x = REFINE_GRID * x + half, .y = REFINE_GRID * y + half, .level = 1};
    group->beyond[SIDE_LEFT] = tree->pixels[refine_tree_place(tree, x > 0 ? x - 1 : x, y)];
    group->beyond[SIDE_RIGHT] = tree->pixels[refine_tree_place(tree, right, y)];
    group->beyond[SIDE_ABOVE] = tree->pixels[refine_tree_place(tree, x, y > 0 ? y - 1 : y)];
    group->beyond[SIDE_BELOW] = tree->pixels[refine_tree_place(tree, x, below)];
    group->cells[GROUP_MIDDLE] = tree->pixels[refine_tree_place(tree, x, y)];
    tree->pixel_groups[(size_t)y * tree->width + x] = (uint32_t)tree->groups.count - 1;
    return true;
}

bool refine_tree_cut_cell(RefineTree *tree, uint32_t number, uint32_t cell, Error *error)
{
    CellGroup *group = NULL;
    uint32_t place[2];
    if (!append_group(tree, &group, error))
        return false;
    CellGroup *parent = &tree->groups.data[number];
    const uint32_t column = cell % GROUP_SIDE, row = cell / GROUP_SIDE;
    refine_tree_cell_place(parent, cell, place);
    *group = (CellGroup){.x = place[0], .y = place[1], .level = parent->level + 1};
    group->beyond[SIDE_LEFT] = column > 0 ? parent->cells[cell - 1] : parent->beyond[SIDE_LEFT];
    group->beyond[SIDE_RIGHT] =
        column + 1 < GROUP_SIDE ? parent->cells[cell + 1] : parent->beyond[SIDE_RIGHT];
    group->beyond[SIDE_ABOVE] =
        row > 0 ? parent->cells[cell - GROUP_SIDE] : parent->beyond[SIDE_ABOVE];
    group->beyond[SIDE_BELOW] =
        row + 1 < GROUP_SIDE ? parent->cells[cell + GROUP_SIDE] : parent->beyond[SIDE_BELOW];
    group->cells[GROUP_MIDDLE] = parent->cells[cell];
    parent->groups[cell] = (uint32_t)tree->groups.count - 1;
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

uint32_t refine_tree_cell_side(uint32_t level)
{
    static const uint32_t sides[REFINE_LEVELS + 1] = {81, 27, 9, 3, 1};
    return sides[level];
}

// A coordinate of the nearest cells beyond a side; below 0 where that is outside.
static int64_t coordinate_beyond(uint32_t middle, uint32_t level, int direction)
{
    const int64_t reach = refine_tree_cell_side(level - 1) / 2 + 1;
    return (int64_t)middle + direction * reach;
}

// Goes down from a pixel to the cell of that level at a place.
static bool find_uncut(const RefineTree *tree, const uint32_t place[2], uint32_t level,
                       CellName *name)
{
    const uint32_t column = place[0] / REFINE_GRID, row = place[1] / REFINE_GRID;
    *name = (CellName){.cell = row * tree->width + column};
    uint32_t below = tree->pixel_groups[name->cell];
    while (below != 0 && name->level < level) {
        const CellGroup *group = &tree->groups.data[below];
        const uint32_t side = refine_tree_cell_side(group->level), half = 3 * side / 2;
        name->group = below;
        name->level = group->level;
        name->cell =
            (place[1] + half - group->y) / side * GROUP_SIDE + (place[0] + half - group->x) / side;
        below = group->groups[name->cell];
    }
    return below == 0;
}

bool refine_tree_neighbor(const RefineTree *tree, const CellGroup *group, CellSide side,
                          CellName *name)
{
    static const int steps[SIDE_COUNT][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
    const int64_t x = coordinate_beyond(group->x, group->level, steps[side][0]);
    const int64_t y = coordinate_beyond(group->y, group->level, steps[side][1]);
    const uint32_t place[2] = {steps[side][0] == 0 ? group->x : (uint32_t)x,
                               steps[side][1] == 0 ? group->y : (uint32_t)y};
    if (x < 0 || y < 0 || place[0] >= tree->width * REFINE_GRID ||
        place[1] >= tree->height * REFINE_GRID)
        return false;
    return find_uncut(tree, place, group->level - 1, name);
}

const SampleData *refine_tree_sample(const RefineTree *tree, const CellName *name)
{
    if (name->group != 0)
        return &tree->groups.data[name->group].cells[name->cell];
    return &tree->pixels[refine_tree_place(tree, name->cell % tree->width,
                                           name->cell / tree->width)];
}

void refine_tree_cell_place(const CellGroup *group, uint32_t cell, uint32_t place[2])
{
    const uint32_t side = refine_tree_cell_side(group->level);
    place[0] = group->x + cell % GROUP_SIDE * side - side;
    place[1] = group->y + cell / GROUP_SIDE * side - side;
}

static void add_group(const RefineTree *tree, uint32_t number, uint64_t sum[3])
{
    const CellGroup *group = &tree->groups.data[number];
    const uint64_t side = refine_tree_cell_side(group->level);
    for (uint32_t cell = 0; cell < GROUP_CELLS; cell++) {
        if (group->groups[cell] != 0)
            add_group(tree, group->groups[cell], sum);
        for (int channel = 0; channel < 3 && group->groups[cell] == 0; channel++)
            sum[channel] += side * side * (uint64_t)(group->cells[cell].color[channel] * 0x1p32f);
    }
}

// Those that a group added to the one of the cell it cuts.
static uint32_t count_added(const RefineTree *tree, uint32_t number)
{
    uint32_t count = GROUP_CELLS - 1;
    const CellGroup *group = &tree->groups.data[number];
    for (uint32_t cell = 0; cell < GROUP_CELLS; cell++)
        if (group->groups[cell] != 0)
            count += count_added(tree, group->groups[cell]);
    return count;
}

uint32_t refine_tree_count(const RefineTree *tree, uint32_t x, uint32_t y)
{
    const uint32_t group = tree->pixel_groups[(size_t)y * tree->width + x];
    return group == 0 ? 1 : 1 + count_added(tree, group);
}

void refine_tree_store_row(const RefineTree *tree, uint32_t y, float (*colors)[3])
{
    const uint64_t cells = (uint64_t)REFINE_GRID * REFINE_GRID;
    for (uint32_t x = 0; x < tree->width; x++) {
        const uint32_t group = tree->pixel_groups[(size_t)y * tree->width + x];
        uint64_t sum[3] = {0};
        if (group == 0) {
            memcpy(colors[x], tree->pixels[refine_tree_place(tree, x, y)].color, sizeof *colors);
            continue;
        }
        add_group(tree, group, sum);
        for (int channel = 0; channel < 3; channel++)
            colors[x][channel] = (float)((sum[channel] + cells / 2) / cells) * 0x1p-32f;
    }
}
