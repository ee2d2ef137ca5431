// SPDX-License-Identifier: MIT
// Groups refer to each other by index, because the array moves when it grows. Means are sums of
// integers, as in render.cl, so that their bits depend only on the samples.
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
    tree->pixels = memory_raw(refine_tree_places(tree), sizeof *tree->pixels, error);
    tree->pixel_groups = memory_zeroed((size_t)width * height, sizeof *tree->pixel_groups, error);
    tree->pixel_seams = memory_zeroed((size_t)width * height, sizeof *tree->pixel_seams, error);
    if (tree->pixels != NULL && tree->pixel_groups != NULL && tree->pixel_seams != NULL &&
        array_push(&tree->groups, none, error) && array_push(&tree->seams, no_seam, error))
        return true;
    refine_tree_free(tree);
    return false;
}

void refine_tree_free(RefineTree *tree)
{
    free(tree->pixels);
    free(tree->pixel_groups);
    free(tree->pixel_seams);
    free(tree->groups.data);
    free(tree->seams.data);
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

void refine_tree_cell_place(const CellGroup *group, uint32_t cell, uint32_t place[2])
{
    const uint32_t side = refine_tree_cell_side(group->level);
    place[0] = group->x + cell % GROUP_SIDE * side - side;
    place[1] = group->y + cell / GROUP_SIDE * side - side;
}

// Computes a place beyond a side of a group. Returns false if it is outside of the picture.
static bool place_beyond(const RefineTree *tree, const CellGroup *group, CellSide side,
                         uint32_t place[2])
{
    const uint32_t reach = refine_tree_cell_side(group->level - 1) / 2 + 1;
    place[0] = group->x;
    place[1] = group->y;
    uint32_t *along = &place[side == SIDE_ABOVE || side == SIDE_BELOW];
    const bool is_low = side == SIDE_LEFT || side == SIDE_ABOVE;
    if (is_low && *along < reach)
        return false;
    *along = is_low ? *along - reach : *along + reach;
    return place[0] < tree->width * REFINE_GRID && place[1] < tree->height * REFINE_GRID;
}

// Finds the smallest cell at a place, down to `level`, through groups with an index below end.
// Returns the group that subdivides this cell, or 0.
static uint32_t descend(const RefineTree *tree, const uint32_t place[2], uint32_t level,
                        uint32_t end, CellName *name)
{
    const uint32_t column = place[0] / REFINE_GRID, row = place[1] / REFINE_GRID;
    *name = (CellName){.cell = row * tree->width + column};
    uint32_t below = tree->pixel_groups[name->cell];
    while (below != 0 && below < end && name->level < level) {
        const CellGroup *group = &tree->groups.data[below];
        const uint32_t side = refine_tree_cell_side(group->level), half = 3 * side / 2;
        name->group = below;
        name->level = group->level;
        name->cell =
            (place[1] + half - group->y) / side * GROUP_SIDE + (place[0] + half - group->x) / side;
        below = group->groups[name->cell];
    }
    return below;
}

bool refine_tree_neighbor(const RefineTree *tree, const CellGroup *group, CellSide side,
                          CellName *name)
{
    uint32_t place[2];
    return place_beyond(tree, group, side, place) &&
           descend(tree, place, group->level - 1, tree->traced, name) == 0;
}

const SampleData *refine_tree_sample(const RefineTree *tree, const CellName *name)
{
    if (name->group != 0)
        return &tree->groups.data[name->group].cells[name->cell];
    return &tree->pixels[refine_tree_place(tree, name->cell % tree->width,
                                           name->cell / tree->width)];
}

const SampleData *refine_tree_sample_at(const RefineTree *tree, const uint32_t place[2])
{
    CellName name;
    descend(tree, place, REFINE_LEVELS, tree->traced, &name);
    return refine_tree_sample(tree, &name);
}

// Copies the sample of the adjacent cell beyond a side, which is as large as the group or larger.
// At the picture's edge, copies the group's own sample.
static void look_beyond(const RefineTree *tree, CellGroup *group, CellSide side)
{
    uint32_t place[2];
    CellName name = {.level = group->level - 1};
    group->beyond[side] = group->cells[GROUP_MIDDLE];
    if (place_beyond(tree, group, side, place)) {
        descend(tree, place, group->level - 1, tree->traced, &name);
        group->beyond[side] = *refine_tree_sample(tree, &name);
    }
    group->beyond_levels[side] = (uint8_t)name.level;
}

static void begin_group(const RefineTree *tree, CellGroup *group, const SampleData *middle)
{
    group->cells[GROUP_MIDDLE] = *middle;
    for (CellSide side = 0; side < SIDE_COUNT; side++)
        look_beyond(tree, group, side);
}

bool refine_tree_cut_pixel(RefineTree *tree, uint32_t x, uint32_t y, Error *error)
{
    const uint32_t half = REFINE_GRID / 2;
    CellGroup *group = NULL;
    if (!append_group(tree, &group, error))
        return false;
    *group = (CellGroup){.x = REFINE_GRID * x + half, .y = REFINE_GRID * y + half, .level = 1};
    begin_group(tree, group, &tree->pixels[refine_tree_place(tree, x, y)]);
    const size_t pixel = (size_t)y * tree->width + x;
    tree->pixel_groups[pixel] = (uint32_t)tree->groups.count - 1;
    for (uint32_t seam = tree->pixel_seams[pixel]; seam != 0; seam = tree->seams.data[seam].next)
        seam_close(&tree->seams.data[seam]);
    return true;
}

// Finds the two neighbors of a pixel along an axis. At the picture's edge, the pixel replaces the
// missing neighbor.
static void neighbors_along(const RefineTree *tree, uint32_t x, uint32_t y, uint32_t stride,
                            const SampleData *beyond[SEAM_ENDS])
{
    const bool is_row = stride == 1;
    const bool is_first = is_row ? x == 0 : y == 0;
    const bool is_last = is_row ? x + 1 == tree->width : y + 1 == tree->height;
    const uint32_t before = is_first ? 0 : 1, after = is_last ? 0 : 1;
    beyond[0] =
        &tree->pixels[refine_tree_place(tree, is_row ? x - before : x, is_row ? y : y - before)];
    beyond[1] =
        &tree->pixels[refine_tree_place(tree, is_row ? x + after : x, is_row ? y : y + after)];
}

static float difference_along(const SampleData *at, const SampleData *beyond[SEAM_ENDS])
{
    return seam_difference(beyond[0], at) + seam_difference(at, beyond[1]);
}

bool refine_tree_open_pixel(RefineTree *tree, uint32_t x, uint32_t y, Error *error)
{
    const SampleData *at = &tree->pixels[refine_tree_place(tree, x, y)];
    const SampleData *row[SEAM_ENDS], *column[SEAM_ENDS];
    neighbors_along(tree, x, y, 1, row);
    neighbors_along(tree, x, y, GROUP_SIDE, column);
    const bool is_row = difference_along(at, row) >= difference_along(at, column);
    const uint32_t half = REFINE_GRID / 2, pixel = y * tree->width + x;
    for (SeamEnd end = SEAM_END_FIRST; end < SEAM_ENDS; end++) {
        const SampleData *beyond = is_row ? row[end] : column[end];
        Seam seam = {.ends = {*at, *at}, .next = tree->pixel_seams[pixel], .cells = 1};
        seam.ends[end] = *beyond;
        seam.x = REFINE_GRID * x + (is_row ? 0 : half);
        seam.y = REFINE_GRID * y + (is_row ? half : 0);
        seam.stride = is_row ? 1 : GROUP_SIDE;
        seam.side = REFINE_GRID;
        seam.from = seam.low = end == SEAM_END_FIRST ? 0 : half;
        seam.to = seam.high = end == SEAM_END_FIRST ? half : REFINE_GRID - 1;
        seam.assumed = (uint8_t)end;
        if (beyond->signature == at->signature)
            continue;
        tree->pixel_seams[pixel] = (uint32_t)tree->seams.count;
        if (!array_push(&tree->seams, seam, error))
            return false;
    }
    return true;
}

bool refine_tree_cut_cell(RefineTree *tree, uint32_t number, uint32_t cell, Error *error)
{
    CellGroup *group = NULL;
    uint32_t place[2];
    if (!append_group(tree, &group, error))
        return false;
    CellGroup *parent = &tree->groups.data[number];
    refine_tree_cell_place(parent, cell, place);
    *group = (CellGroup){.x = place[0], .y = place[1], .level = parent->level + 1};
    begin_group(tree, group, &parent->cells[cell]);
    parent->groups[cell] = (uint32_t)tree->groups.count - 1;
    return true;
}

// Computes the color sum of each cell of a group from its sample and the group's seams. Ignores
// subdivisions of the cells.
static void refine_tree_cells(const RefineTree *tree, const CellGroup *group,
                              ColorSum sums[GROUP_CELLS])
{
    const uint32_t side = refine_tree_cell_side(group->level);
    for (uint32_t cell = 0; cell < GROUP_CELLS; cell++)
        for (int channel = 0; channel < 3; channel++)
            sums[cell][channel] =
                2 * side * side * seam_color_steps(group->cells[cell].color[channel]);
    for (uint32_t number = group->seams; number != 0; number = tree->seams.data[number].next)
        seam_correct(&tree->seams.data[number], group->cells, sums);
}

static void add_group(const RefineTree *tree, uint32_t number, ColorSum sum)
{
    const CellGroup *group = &tree->groups.data[number];
    ColorSum sums[GROUP_CELLS];
    refine_tree_cells(tree, group, sums);
    for (uint32_t cell = 0; cell < GROUP_CELLS; cell++) {
        if (group->groups[cell] != 0)
            add_group(tree, group->groups[cell], sum);
        for (int channel = 0; channel < 3 && group->groups[cell] == 0; channel++)
            sum[channel] += sums[cell][channel];
    }
}

// Returns the number of samples that a group and its subdivisions have added.
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
    uint32_t count = 1 + (group == 0 ? 0 : count_added(tree, group));
    for (uint32_t seam = tree->pixel_seams[(size_t)y * tree->width + x]; seam != 0;
         seam = tree->seams.data[seam].next)
        count += tree->seams.data[seam].samples;
    return count;
}

static void mean_of(const ColorSum sum, uint64_t side, float mean[3])
{
    for (int channel = 0; channel < 3; channel++)
        mean[channel] = (float)((sum[channel] + side * side) / (2 * side * side)) * 0x1p-32f;
}

// Computes the mean color of the cell that a group subdivides.
static void refine_tree_mean(const RefineTree *tree, uint32_t group, float mean[3])
{
    ColorSum sum = {0};
    add_group(tree, group, sum);
    mean_of(sum, refine_tree_cell_side(tree->groups.data[group].level - 1), mean);
}

static void pixel_color(const RefineTree *tree, uint32_t x, uint32_t y, float color[3])
{
    const SampleData *at = &tree->pixels[refine_tree_place(tree, x, y)];
    uint32_t seam = tree->pixel_seams[(size_t)y * tree->width + x];
    memcpy(color, at->color, sizeof at->color);
    if (seam == 0)
        return;
    ColorSum sum;
    for (int channel = 0; channel < 3; channel++)
        sum[channel] = 2 * REFINE_GRID * REFINE_GRID * seam_color_steps(at->color[channel]);
    for (; seam != 0; seam = tree->seams.data[seam].next)
        seam_correct(&tree->seams.data[seam], at, &sum);
    mean_of(sum, REFINE_GRID, color);
}

static void store_pixel(const RefineTree *tree, uint32_t x, uint32_t y, float color[3])
{
    const uint32_t group = tree->pixel_groups[(size_t)y * tree->width + x];
    if (group != 0)
        refine_tree_mean(tree, group, color);
    else
        pixel_color(tree, x, y, color);
}

// Returns whether each pixel of a packet's row has one sample.
static bool is_plain(const RefineTree *tree, size_t first)
{
    uint32_t more = 0;
    for (uint32_t i = 0; i < PACKET_SIDE; i++)
        more |= tree->pixel_groups[first + i] | tree->pixel_seams[first + i];
    return more == 0;
}

void refine_tree_store_row(const RefineTree *tree, uint32_t y, float (*colors)[3])
{
    for (uint32_t left = 0; left < tree->width; left += PACKET_SIDE) {
        const SampleData *pixels = &tree->pixels[refine_tree_place(tree, left, y)];
        const uint32_t beyond = tree->width - left;
        const uint32_t count = beyond < PACKET_SIDE ? beyond : PACKET_SIDE;
        if (count == PACKET_SIDE && is_plain(tree, (size_t)y * tree->width + left))
            for (uint32_t i = 0; i < PACKET_SIDE; i++)
                memcpy(colors[left + i], pixels[i].color, sizeof pixels[i].color);
        else
            for (uint32_t i = 0; i < count; i++)
                store_pixel(tree, left + i, y, colors[left + i]);
    }
}
