// SPDX-License-Identifier: MIT
// Threads list the cells to subdivide, in one list per range of pixels or groups. One thread then
// subdivides the listed cells, range by range.
#include "refine/contrast.h"

#include <stdlib.h>

#define GROUPS_OF_TASK 512

// The cells to subdivide in a range, or the error that stopped the search.
typedef struct {
    ARRAY(CellName) cells;
    Error error;
} CutList;

typedef struct {
    const RefineTree *tree;
    const CutRule *rule;
    uint32_t first;                  // the first group to examine
    float limits[REFINE_LEVELS + 1]; // largest color difference that needs no subdivision, by level
    CutList *lists;                  // of each range
} Marking;

// Sets the limits by level. Color differences of whole pixels count twice, because different
// surfaces may have similar colors by chance. Differences of smaller cells count half, because
// seams locate the edges there.
static void set_limits(Marking *marking)
{
    float fraction = 1;
    marking->limits[0] = marking->rule->threshold / 2;
    for (uint32_t level = 1; level < REFINE_LEVELS; level++) {
        fraction /= GROUP_CELLS;
        marking->limits[level] = 2 * marking->rule->threshold / fraction;
    }
    marking->limits[REFINE_LEVELS] = INFINITY;
}

// Lists a cell if it has thin parts, or if its difference from a neighbor exceeds the cell's limit.
// Also lists a larger neighbor if its difference from the cell exceeds the neighbor's limit.
static bool mark_cell(const Marking *marking, const CellName *name, const uint32_t place[2],
                      CutList *list)
{
    static const int steps[4][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
    const RefineTree *tree = marking->tree;
    const SampleData *sample = refine_tree_sample(tree, name);
    const uint32_t side = refine_tree_cell_side(name->level);
    bool is_cut = thin_parts_cut(marking->rule->thin_parts, place, name->level);
    for (int i = 0; i < 4; i++) {
        const uint32_t beyond[2] = {place[0] + (uint32_t)steps[i][0] * side,
                                    place[1] + (uint32_t)steps[i][1] * side};
        CellName other;
        if (!refine_tree_find(tree, beyond, &other))
            continue;
        const float difference = seam_difference(sample, refine_tree_sample(tree, &other));
        is_cut = is_cut || difference > marking->limits[name->level];
        if (other.level < name->level && difference > marking->limits[other.level] &&
            !array_push(&list->cells, other, &list->error))
            return false;
    }
    return !is_cut || array_push(&list->cells, *name, &list->error);
}

static const SampleData *pixel_sample(const RefineTree *tree, uint32_t x, uint32_t y)
{
    return &tree->pixels[refine_tree_place(tree, x, y)];
}

// Returns whether a pixel differs from a neighbor by more than the limit. At the picture's edge, a
// pixel is its own neighbor.
static bool pixel_differs(const RefineTree *tree, uint32_t x, uint32_t y, float limit)
{
    const SampleData *sample = pixel_sample(tree, x, y);
    return seam_difference(sample, pixel_sample(tree, x - (x > 0), y)) > limit ||
           seam_difference(sample, pixel_sample(tree, x + (x + 1 < tree->width), y)) > limit ||
           seam_difference(sample, pixel_sample(tree, x, y - (y > 0))) > limit ||
           seam_difference(sample, pixel_sample(tree, x, y + (y + 1 < tree->height))) > limit;
}

static bool mark_pixel(const Marking *marking, uint32_t x, uint32_t y, CutList *list)
{
    const RefineTree *tree = marking->tree;
    const uint32_t place[2] = {x * REFINE_GRID, y * REFINE_GRID};
    const CellName name = {.cell = y * tree->width + x};
    return !(pixel_differs(tree, x, y, marking->limits[0]) ||
             thin_parts_cut(marking->rule->thin_parts, place, 0)) ||
           array_push(&list->cells, name, &list->error);
}

static void mark_rows(void *context, uint32_t first, uint32_t end)
{
    const Marking *marking = context;
    const RefineTree *tree = marking->tree;
    CutList *list = &marking->lists[first / PACKET_SIDE];
    for (uint32_t left = 0; left < tree->width; left += PACKET_SIDE)
        for (uint32_t y = first; y < end; y++)
            for (uint32_t x = left; x < tree->width && x < left + PACKET_SIDE; x++)
                if (!mark_pixel(marking, x, y, list))
                    return;
}

static bool mark_group(const Marking *marking, uint32_t number, CutList *list)
{
    const CellGroup *group = &marking->tree->groups.data[number];
    for (uint32_t cell = 0; cell < GROUP_CELLS; cell++) {
        const CellName name = {number, cell, group->level};
        uint32_t place[2];
        refine_tree_cell_place(group, cell, place);
        if (!mark_cell(marking, &name, place, list))
            return false;
    }
    return true;
}

static void mark_groups(void *context, uint32_t first, uint32_t end)
{
    const Marking *marking = context;
    for (uint32_t i = first; i < end; i++)
        if (!mark_group(marking, marking->first + i, &marking->lists[first / GROUPS_OF_TASK]))
            return;
}

static bool cut_list(RefineTree *tree, const CutList *list, Error *error)
{
    if (list->error.text[0] != '\0')
        return error_set(error, "%s", list->error.text);
    for (size_t i = 0; i < list->cells.count; i++)
        if (!refine_tree_cut(tree, &list->cells.data[i], error))
            return false;
    return true;
}

// The pixel rows or the groups to examine. Threads call `mark` for `part` of them at a time.
typedef struct {
    uint32_t count, part;
    ThreadPoolPart *mark;
} RangeWork;

static bool cut_marked(RefineTree *tree, Marking *marking, const RangeWork *ranges,
                       ThreadPool *pool, Error *error)
{
    const uint32_t tasks = range_count(ranges->count, ranges->part);
    set_limits(marking);
    marking->lists = memory_zeroed(tasks, sizeof *marking->lists, error);
    bool ok = marking->lists != NULL;
    if (ok)
        thread_pool_share(pool, ranges->count, ranges->part, ranges->mark, marking);
    for (uint32_t task = 0; marking->lists != NULL && task < tasks; task++) {
        ok = ok && cut_list(tree, &marking->lists[task], error);
        free(marking->lists[task].cells.data);
    }
    free(marking->lists);
    return ok;
}

bool contrast_cut_pixels(RefineTree *tree, const CutRule *rule, ThreadPool *pool, Error *error)
{
    Marking marking = {.tree = tree, .rule = rule};
    const RangeWork rows = {tree->height, PACKET_SIDE, mark_rows};
    return cut_marked(tree, &marking, &rows, pool, error);
}

bool contrast_cut_groups(RefineTree *tree, const CutRule *rule, uint32_t first, ThreadPool *pool,
                         Error *error)
{
    Marking marking = {.tree = tree, .rule = rule, .first = first};
    const RangeWork groups = {(uint32_t)tree->groups.count - first, GROUPS_OF_TASK, mark_groups};
    return cut_marked(tree, &marking, &groups, pool, error);
}
