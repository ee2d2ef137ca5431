// SPDX-License-Identifier: MIT
// A split partitions a node's triangles from one array into the same range of a second array. The
// splits of the children write the triangles back into the first array. An explicit stack holds the
// pending nodes, so that no recursion overflows.
#include "accel/build.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

static BuildItem *items_of(const Build *build, const BuildTask *task)
{
    return build->items[task->depth % 2] + task->first;
}

static BuildRange range_of(const Build *build, const BuildTask *task)
{
    BuildRange range = {.items = items_of(build, task),
                        .count = task->count,
                        .box = bounds_empty(),
                        .centers = bounds_empty(),
                        .depth = task->depth,
                        .total = build->total,
                        .leaves = build->leaves};
    for (uint32_t i = 0; i < range.count; i++) {
        const Bounds center = bounds_of_center(&range.items[i].bounds);
        bounds_unite(&range.box, &range.items[i].bounds);
        bounds_unite(&range.centers, &center);
    }
    return range;
}

// Copies the left items to `other`, followed by the right items. Each side keeps its order.
static void move_sides(const BuildRange *range, const Split *split, BuildItem *other)
{
    BuildItem *left = other, *right = other + split->left;
    for (uint32_t i = 0; i < range->count; i++) {
        const bool is_left = split_is_left(split, &range->items[i]);
        BuildItem *place = is_left ? left : right;
        *place = range->items[i];
        left += is_left;
        right += !is_left;
    }
}

static int longest_axis(const Bounds *bounds)
{
    int longest = 0;
    for (int axis = 1; axis < 3; axis++)
        if (bounds_extent(bounds, axis) > bounds_extent(bounds, longest))
            longest = axis;
    return longest;
}

static int compare_centers(const void *first, const void *second, void *axis)
{
    const BuildItem *a = first, *b = second;
    const float x = item_center(a, *(int *)axis), y = item_center(b, *(int *)axis);
    if (x != y)
        return x < y ? -1 : 1;
    return a->number < b->number ? -1 : 1;
}

// Copies the items to `other`, sorted by center along the axis on which the centers extend most.
// The caller halves the result. This works even if all centers are equal.
static void move_halves(const BuildRange *range, BuildItem *other)
{
    int axis = longest_axis(&range->centers);
    memcpy(other, range->items, range->count * sizeof *other);
    if (bounds_extent(&range->centers, axis) > 0)
        qsort_r(other, range->count, sizeof *other, compare_centers, &axis);
}

static void make_leaf(const Build *build, const BuildTask *task)
{
    const BuildItem *items = items_of(build, task);
    build->bvh->nodes[task->node].first = task->first;
    build->bvh->nodes[task->node].count = task->count;
    for (uint32_t i = 0; i < task->count; i++)
        build->bvh->order[task->first + i] = items[i].number;
}

void build_divide(const Build *build, BuildTask *task)
{
    BuildItem *other = build->items[(task->depth + 1) % 2] + task->first;
    assert(task->depth <= BVH_MAX_DEPTH);
    const BuildRange range = range_of(build, task);
    const Split split = build->split(&range);
    build->bvh->nodes[task->node].box = bounds_box(&range.box);
    task->left = split.left;
    switch (split.kind) {
    case SPLIT_NONE:
        make_leaf(build, task);
        break;
    case SPLIT_PLANE:
        move_sides(&range, &split, other);
        break;
    case SPLIT_HALVES:
        move_halves(&range, other);
        task->left = task->count / 2;
        break;
    }
}

void build_set_children(const Build *build, const BuildTask *task, uint32_t child,
                        BuildTask children[2])
{
    BvhNode *node = &build->bvh->nodes[task->node];
    const uint32_t left = task->left, depth = task->depth + 1;
    node->first = child;
    node->count = 0;
    children[0] = (BuildTask){child, task->first, left, depth, 0};
    children[1] = (BuildTask){child + 1, task->first + left, task->count - left, depth, 0};
}

void build_subtree(const Build *build, const BuildTask *root)
{
    BuildTask stack[BVH_STACK_SIZE] = {*root};
    uint32_t child = 2 * root->first + 1;
    for (uint32_t count = 1; count > 0;) {
        BuildTask next = stack[--count];
        build_divide(build, &next);
        if (next.left == 0)
            continue;
        build_set_children(build, &next, child, stack + count);
        count += 2;
        child += 2;
    }
}
