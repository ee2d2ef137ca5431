// SPDX-License-Identifier: MIT
// Sorts a node's triangles into grid cells and divides the cells, which are far fewer. A part with
// few cells but many triangles gets its own, finer grid.
#include "accel/upper.h"

#include <stdlib.h>
#include <string.h>

// Cells divide nodes with more than USUAL_TRIANGLES triangles and at least FEWEST_CELLS cells. With
// fewer cells, the planes between them would be too far from the best plane.
#define USUAL_TRIANGLES 8192
#define FEWEST_CELLS    32

// From this depth on, triangles are distributed so unevenly that grids hardly divide them.
#define DEEPEST_GRID 24

// A node that consists of some of the cells.
typedef struct {
    BuildTask task;
    uint32_t first_item, item_count;
    uint32_t array; // which of Division::items holds its cells
} CellTask;

typedef struct {
    const Build *build;
    Upper *upper;
    Cells cells;
    BuildItem *items[2]; // the cells, and a buffer of the same size
} Division;

static bool is_divided_by_cells(const Division *division, const CellTask *node)
{
    const bool is_whole = node->item_count == division->cells.count;
    return node->task.count > USUAL_TRIANGLES && node->task.depth < DEEPEST_GRID &&
           node->item_count >= (is_whole ? 2 : FEWEST_CELLS);
}

static Split split_cells(const Division *division, const CellTask *node, const BuildItem *items)
{
    const Build *build = division->build;
    const Measure measure = build_measure(items, node->item_count);
    const BuildRange range = {.items = items,
                              .count = node->item_count,
                              .weight = node->task.count,
                              .box = measure.box,
                              .centers = measure.centers,
                              .depth = node->task.depth,
                              .total = (uint32_t)build->triangles->count,
                              .leaves = build->leaves};
    build->bvh->nodes[node->task.node].box = bounds_box(&measure.box);
    return build->split(&range);
}

static uint32_t count_left(const Split *split, const BuildItem *items, uint32_t count)
{
    uint32_t left = 0;
    for (uint32_t i = 0; i < count; i++)
        left += split_is_left(split, &items[i]);
    return left;
}

// Stores the node's triangles in Bvh::order. Lists the node as a subtree, or as a task if a finer
// grid may divide it.
static bool finish_node(const Division *division, const CellTask *node, bool is_stuck, Error *error)
{
    const Cells *cells = &division->cells;
    const BuildItem *items = division->items[node->array] + node->first_item;
    uint32_t *order = division->build->bvh->order + node->task.first;
    for (uint32_t i = 0; i < node->item_count; i++) {
        memcpy(order, cells->numbers + cells->starts[items[i].number],
               items[i].weight * sizeof *order);
        order += items[i].weight;
    }
    if (is_stuck || node->task.count <= SUBTREE_TRIANGLES || node->task.depth >= DEEPEST_GRID)
        return array_push(&division->upper->subtrees, node->task, error);
    return array_push(&division->upper->tasks, node->task, error);
}

// Divides the node's cells. DEEPEST_GRID bounds the recursion.
static bool divide(const Division *division, const CellTask *node, Error *error)
{
    const bool is_whole = node->item_count == division->cells.count;
    if (!is_divided_by_cells(division, node))
        return finish_node(division, node, is_whole, error);
    const BuildItem *items = division->items[node->array] + node->first_item;
    BuildItem *other = division->items[!node->array] + node->first_item;
    const Split split = split_cells(division, node, items);
    if (split.kind != SPLIT_PLANE)
        return finish_node(division, node, is_whole, error);
    const uint32_t left_items = count_left(&split, items, node->item_count);
    build_move(items, node->item_count, &split, other, other + left_items);
    BuildTask children[2];
    build_inner(division->build, &node->task, split.left, 2 * (node->task.first + split.left) - 1,
                children);
    const CellTask left = {children[0], node->first_item, left_items, !node->array};
    const CellTask right = {children[1], node->first_item + left_items,
                            node->item_count - left_items, !node->array};
    return array_push(&division->upper->nodes, node->task.node, error) &&
           divide(division, &left, error) && divide(division, &right, error);
}

static bool divide_node(Upper *upper, const Build *build, const BuildTask *task, ThreadPool *pool,
                        Error *error)
{
    Division division = {.build = build, .upper = upper};
    const CellSource source = {build->triangles, build->bvh->order + task->first, task->count};
    if (!cells_make(&division.cells, &source, pool, error))
        return false;
    const uint32_t count = division.cells.count;
    const CellTask node = {*task, 0, count, 0};
    division.items[0] = division.cells.items;
    division.items[1] = memory_raw(count, sizeof *division.items[1], error);
    const bool ok = division.items[1] != NULL && divide(&division, &node, error);
    free(division.items[1]);
    cells_free(&division.cells);
    return ok;
}

// Puts the largest subtrees first. The small ones at the end balance the load of the threads.
static int compare_subtrees(const void *first, const void *second)
{
    const BuildTask *a = first, *b = second;
    if (a->count != b->count)
        return a->count > b->count ? -1 : 1;
    return a->first < b->first ? -1 : 1;
}

bool upper_divide(Upper *upper, const Build *build, ThreadPool *pool, Error *error)
{
    const BuildTask root = {.count = (uint32_t)build->triangles->count, .depth = 1};
    if (root.count <= USUAL_TRIANGLES)
        return array_push(&upper->subtrees, root, error);
    bool ok = array_push(&upper->tasks, root, error);
    while (ok && upper->tasks.count > 0) {
        const BuildTask task = upper->tasks.data[--upper->tasks.count];
        ok = divide_node(upper, build, &task, pool, error);
    }
    if (ok)
        qsort(upper->subtrees.data, upper->subtrees.count, sizeof(BuildTask), compare_subtrees);
    return ok;
}

void upper_free(Upper *upper)
{
    free(upper->nodes.memory);
    free(upper->subtrees.memory);
    free(upper->tasks.memory);
    *upper = (Upper){0};
}
