// SPDX-License-Identifier: MIT
// A split partitions a node's items from one array into the same positions of a second array. The
// splits of the children write them back into the first. An explicit stack holds the pending nodes,
// so that no recursion overflows.
#include "accel/build.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

// A pending node, and which of the two arrays holds its items.
typedef struct {
    BuildTask task;
    uint32_t array;
} Waiting;

typedef struct {
    const Build *build;
    BuildItem *items[2];
    uint32_t first; // position of its first triangle in Bvh::order
    BuildCounts *counts;
} Subtree;

Measure build_measure(const BuildItem *items, uint32_t count)
{
    Measure measure = {bounds_empty(), bounds_empty()};
    for (uint32_t i = 0; i < count; i++) {
        const Bounds center = bounds_of_center(&items[i].bounds);
        bounds_unite(&measure.box, &items[i].bounds);
        bounds_unite(&measure.centers, &center);
    }
    return measure;
}

void build_move(const BuildItem *items, uint32_t count, const Split *split, BuildItem *left,
                BuildItem *right)
{
    for (uint32_t i = 0; i < count; i++) {
        const bool is_left = split_is_left(split, &items[i]);
        BuildItem *place = is_left ? left : right;
        *place = items[i];
        left += is_left;
        right += !is_left;
    }
}

#define COMPARE_ON_AXIS(axis)                                                                      \
    static int compare_##axis(const void *first, const void *second)                               \
    {                                                                                              \
        const BuildItem *a = first, *b = second;                                                   \
        const float x = item_center(a, axis), y = item_center(b, axis);                            \
        if (x != y)                                                                                \
            return x < y ? -1 : 1;                                                                 \
        return a->number < b->number ? -1 : 1;                                                     \
    }
COMPARE_ON_AXIS(0)
COMPARE_ON_AXIS(1)
COMPARE_ON_AXIS(2)

static int longest_axis(const Bounds *bounds)
{
    int longest = 0;
    for (int axis = 1; axis < 3; axis++)
        if (bounds_extent(bounds, axis) > bounds_extent(bounds, longest))
            longest = axis;
    return longest;
}

// Copies the items to other, sorted by center along the longest axis. The caller halves the result.
// This works for any set of items, even if all are equal.
static void move_halves(const BuildItem *items, BuildItem *other, uint32_t count,
                        const Bounds *centers)
{
    static int (*const compare[3])(const void *, const void *) = {compare_0, compare_1, compare_2};
    const int axis = longest_axis(centers);
    memcpy(other, items, count * sizeof *items);
    if (bounds_extent(centers, axis) > 0)
        qsort(other, count, sizeof *other, compare[axis]);
}

// Chooses a split and moves the items to the other array. Returns the number of items in the left
// child; 0 if the node is a leaf.
static uint32_t divide(const Subtree *subtree, const Waiting *waiting)
{
    const BuildTask *task = &waiting->task;
    const uint32_t first = task->first - subtree->first;
    const BuildItem *items = subtree->items[waiting->array] + first;
    BuildItem *other = subtree->items[!waiting->array] + first;
    const Measure measure = build_measure(items, task->count);
    subtree->build->bvh->nodes[task->node].box = bounds_box(&measure.box);
    const BuildRange range = {.items = items,
                              .count = task->count,
                              .weight = task->count,
                              .box = measure.box,
                              .centers = measure.centers,
                              .depth = task->depth,
                              .total = (uint32_t)subtree->build->triangles->count,
                              .leaves = subtree->build->leaves};
    const Split split = subtree->build->split(&range);
    switch (split.kind) {
    case SPLIT_NONE:
        return 0;
    case SPLIT_PLANE:
        build_move(items, task->count, &split, other, other + split.left);
        return split.left;
    case SPLIT_HALVES:
        break;
    }
    move_halves(items, other, task->count, &measure.centers);
    return task->count / 2;
}

static void make_leaf(const Subtree *subtree, const Waiting *waiting)
{
    Bvh *bvh = subtree->build->bvh;
    const BuildTask *task = &waiting->task;
    const BuildItem *items = subtree->items[waiting->array] + (task->first - subtree->first);
    BuildCounts *counts = subtree->counts;
    bvh->nodes[task->node].first = task->first;
    bvh->nodes[task->node].count = task->count;
    bvh->nodes[task->node].leaf_count = 1;
    for (uint32_t i = 0; i < task->count; i++)
        bvh->order[task->first + i] = items[i].number;
    counts->leaf_count++;
    if (counts->largest_leaf < task->count)
        counts->largest_leaf = task->count;
    if (counts->depth < task->depth)
        counts->depth = task->depth;
}

static void make_items(const Subtree *subtree, uint32_t count)
{
    const uint32_t *numbers = subtree->build->bvh->order + subtree->first;
    for (uint32_t i = 0; i < count; i++) {
        BuildItem *item = &subtree->items[0][i];
        item->bounds = bounds_of_triangle(subtree->build->triangles, numbers[i]);
        item->number = numbers[i];
        item->weight = 1;
    }
}

void build_inner(const Build *build, const BuildTask *task, uint32_t left, uint32_t child,
                 BuildTask children[2])
{
    BvhNode *node = &build->bvh->nodes[task->node];
    const uint32_t depth = task->depth + 1;
    node->first = child;
    node->count = 0;
    children[0] = (BuildTask){child, task->first, left, depth};
    children[1] = (BuildTask){child + 1, task->first + left, task->count - left, depth};
}

void build_count_leaves(Bvh *bvh, uint32_t number)
{
    BvhNode *node = &bvh->nodes[number];
    if (node->count == 0)
        node->leaf_count =
            bvh->nodes[node->first].leaf_count + bvh->nodes[node->first + 1].leaf_count;
}

void build_subtree(const Build *build, const BuildTask *root, BuildItem *items, BuildCounts *counts)
{
    const Subtree subtree = {build, {items, items + root->count}, root->first, counts};
    Waiting waiting[BVH_STACK_SIZE] = {{*root, 0}};
    uint32_t child = 2 * root->first + 1;
    make_items(&subtree, root->count);
    for (uint32_t count = 1; count > 0;) {
        BuildTask children[2];
        const Waiting next = waiting[--count];
        assert(next.task.depth <= BVH_MAX_DEPTH);
        const uint32_t left = divide(&subtree, &next);
        if (left == 0) {
            make_leaf(&subtree, &next);
            continue;
        }
        build_inner(build, &next.task, left, child, children);
        waiting[count++] = (Waiting){children[1], !next.array};
        waiting[count++] = (Waiting){children[0], !next.array};
        counts->node_count += 2;
        child += 2;
    }
    // Children have higher indices than their parents, so this loop visits children first.
    while (child > 2 * root->first + 1)
        build_count_leaves(build->bvh, --child);
    build_count_leaves(build->bvh, root->node);
}
