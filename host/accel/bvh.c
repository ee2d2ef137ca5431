// SPDX-License-Identifier: MIT
// Divides the triangles top down.  Both children of a node are made at once and stand side by
// side; the nodes still to divide wait on a list, so that no recursion can run out of stack.
#include "accel/bvh.h"

#include "accel/split.h"

#include <assert.h>
#include <stdlib.h>

typedef struct {
    uint32_t node, first, count, depth;
} Task;

typedef struct {
    Bvh *bvh;
    BuildItem *items;
    uint32_t total, inner_count;
    uint32_t (*split)(const BuildRange *);
    ARRAY(Task) tasks;
} Build;

static BuildItem *items_of(const Triangles *triangles, Error *error)
{
    BuildItem *items = memory_raw(triangles->count, sizeof *items, error);
    if (items == NULL)
        return NULL;
    for (size_t i = 0; i < triangles->count; i++) {
        Box box = box_empty();
        for (int corner = 0; corner < 3; corner++)
            box_include_point(&box, triangles->corners[i][corner]);
        items[i] = (BuildItem){.low = {box.low[0], box.low[1], box.low[2]},
                               .triangle = (uint32_t)i,
                               .high = {box.high[0], box.high[1], box.high[2]}};
    }
    return items;
}

static Box box_of_items(const BuildItem *items, uint32_t count)
{
    Box box = box_empty();
    for (uint32_t i = 0; i < count; i++) {
        box_include_point(&box, items[i].low);
        box_include_point(&box, items[i].high);
    }
    return box;
}

static void make_leaf(Build *build, Task task)
{
    Bvh *bvh = build->bvh;
    bvh->nodes[task.node].first = task.first;
    bvh->nodes[task.node].count = task.count;
    bvh->leaf_count++;
    bvh->largest_leaf = task.count > bvh->largest_leaf ? task.count : bvh->largest_leaf;
}

static bool divide(Build *build, Task task, Error *error)
{
    Bvh *bvh = build->bvh;
    BvhNode *node = &bvh->nodes[task.node];
    bvh->depth = task.depth > bvh->depth ? task.depth : bvh->depth;
    assert(task.depth <= BVH_MAX_DEPTH);
    node->box = box_of_items(build->items + task.first, task.count);
    const BuildRange range = {build->items + task.first, task.count, node->box, task.depth,
                              build->total};
    const uint32_t left = build->split(&range);
    if (left == 0) {
        make_leaf(build, task);
        return true;
    }
    const uint32_t child = bvh->node_count;
    node->first = child;
    node->inner = build->inner_count++;
    bvh->node_count += 2;
    const Task tasks[2] = {{child, task.first, left, task.depth + 1},
                           {child + 1, task.first + left, task.count - left, task.depth + 1}};
    return array_push(&build->tasks, tasks[1], error) && array_push(&build->tasks, tasks[0], error);
}

static bool divide_all(Build *build, Error *error)
{
    const Task root = {0, 0, build->total, 1};
    build->bvh->node_count = 1;
    if (!array_push(&build->tasks, root, error))
        return false;
    while (build->tasks.count > 0)
        if (!divide(build, build->tasks.data[--build->tasks.count], error))
            return false;
    for (uint32_t place = 0; place < build->total; place++)
        build->bvh->order[place] = build->items[place].triangle;
    return true;
}

bool bvh_build(Bvh *bvh, const Triangles *triangles, BvhBuilder builder, Error *error)
{
    *bvh = (Bvh){0};
    if (triangles->count == 0)
        return true;
    Build build = {.bvh = bvh,
                   .total = (uint32_t)triangles->count,
                   .split = builder == BVH_MIDPOINT ? split_midpoint : split_sah};
    bvh->nodes = memory_zeroed(2 * triangles->count, sizeof *bvh->nodes, error);
    bvh->order = memory_raw(triangles->count, sizeof *bvh->order, error);
    build.items = items_of(triangles, error);
    const bool ok = bvh->nodes != NULL && bvh->order != NULL && build.items != NULL &&
                    divide_all(&build, error);
    free(build.items);
    free(build.tasks.memory);
    if (!ok)
        bvh_free(bvh);
    return ok;
}

void bvh_free(Bvh *bvh)
{
    free(bvh->nodes);
    free(bvh->order);
    *bvh = (Bvh){0};
}
