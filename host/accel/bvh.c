// SPDX-License-Identifier: MIT
// Builds the tree top down. The threads first divide the large nodes, level by level. They then
// build the remaining subtrees, one per thread at a time.
//
// Invariant: a subtree's range of triangles determines the indices of its nodes. The tree therefore
// does not depend on the schedule of the threads.
#include "accel/bvh.h"

#include "accel/build.h"
#include "base/array.h"

#include <stdlib.h>

// The largest number of triangles in a subtree that one thread builds.
#define SUBTREE_TRIANGLES 65536

typedef struct {
    Build build;
    const Triangles *triangles;
    const Box *boxes; // instead of triangles, if not NULL
    ThreadPool *pool;
    ARRAY(BuildTask) subtrees;
    ARRAY(BuildTask) large; // nodes above the subtrees, level by level
    size_t next;            // index in `large` of the first node to divide
} Whole;

static void make_items(void *context, uint32_t first, uint32_t end)
{
    const Whole *whole = context;
    for (uint32_t number = first; number < end; number++) {
        BuildItem *item = &whole->build.items[1][number];
        item->box = whole->boxes != NULL ? build_box_of(&whole->boxes[number])
                                         : build_box_of_triangle(whole->triangles, number);
        item->number = number;
        item->unused = 0;
    }
}

static void divide_large(void *context, uint32_t number)
{
    const Whole *whole = context;
    build_divide(&whole->build, &whole->large.data[whole->next + number]);
}

static void build_small(void *context, uint32_t number)
{
    const Whole *whole = context;
    build_subtree(&whole->build, &whole->subtrees.data[number]);
}

static bool add_task(Whole *whole, const BuildTask *task, Error *error)
{
    return task->count > SUBTREE_TRIANGLES ? array_push(&whole->large, *task, error)
                                           : array_push(&whole->subtrees, *task, error);
}

// Divides a level of large nodes. In memory, a node's two children lie between the nodes below the
// left child and the nodes below the right child.
static bool divide_next(Whole *whole, Error *error)
{
    const size_t end = whole->large.count;
    bool ok = true;
    thread_pool_run(whole->pool, (uint32_t)(end - whole->next), divide_large, whole);
    for (; ok && whole->next < end; whole->next++) {
        BuildTask children[2];
        const BuildTask task = whole->large.data[whole->next];
        if (task.left == 0)
            continue;
        build_set_children(&whole->build, &task, 2 * (task.first + task.left) - 1, children);
        ok = add_task(whole, &children[0], error) && add_task(whole, &children[1], error);
    }
    return ok;
}

// Orders subtrees from the largest to the smallest. The small subtrees at the end balance the load
// of the threads.
static int compare_subtrees(const void *first, const void *second)
{
    const BuildTask *a = first, *b = second;
    return (a->count < b->count) - (a->count > b->count);
}

// Counts the nodes, leaves and levels of a subtree. The depth of the tree bounds the recursion.
static void count_nodes(Bvh *bvh, uint32_t number, uint32_t parents)
{
    const BvhNode *node = &bvh->nodes[number];
    bvh->node_count++;
    if (node->count > 0) {
        bvh->leaf_count++;
        bvh->largest_leaf = node->count > bvh->largest_leaf ? node->count : bvh->largest_leaf;
        bvh->depth = parents + 1 > bvh->depth ? parents + 1 : bvh->depth;
        return;
    }
    bvh->inner_counts[parents]++;
    count_nodes(bvh, node->first, parents + 1);
    count_nodes(bvh, node->first + 1, parents + 1);
}

static bool build_all(Whole *whole, Error *error)
{
    Bvh *bvh = whole->build.bvh;
    const uint32_t total = whole->build.total;
    const BuildTask root = {.count = total, .depth = 1};
    bvh->nodes = memory_sparse(2 * (size_t)total - 1, sizeof *bvh->nodes, error);
    bvh->order = memory_raw(total, sizeof *bvh->order, error);
    for (int i = 0; i < 2; i++)
        whole->build.items[i] = memory_raw(total, sizeof(BuildItem), error);
    if (bvh->nodes == NULL || bvh->order == NULL || whole->build.items[0] == NULL ||
        whole->build.items[1] == NULL)
        return false;
    thread_pool_share(whole->pool, total, CHUNK_ELEMENTS, make_items, whole);
    bool ok = add_task(whole, &root, error);
    while (ok && whole->next < whole->large.count)
        ok = divide_next(whole, error);
    if (!ok)
        return false;
    const uint32_t subtrees = (uint32_t)whole->subtrees.count;
    if (subtrees > 0) // qsort accepts no null pointer
        qsort(whole->subtrees.data, subtrees, sizeof(BuildTask), compare_subtrees);
    thread_pool_run(whole->pool, subtrees, build_small, whole);
    count_nodes(bvh, 0, 0);
    return true;
}

// Builds the tree over whole->build.total triangles or boxes.
static bool build_whole(Whole *whole, const BvhSettings *settings, Error *error)
{
    Build *build = &whole->build;
    *build->bvh = (Bvh){0};
    if (build->total == 0)
        return true;
    build->split = settings->builder == BVH_MIDPOINT ? split_midpoint : split_sah;
    build->leaves = settings->leaves;
    const bool ok = build_all(whole, error);
    free(build->items[0]);
    free(build->items[1]);
    free(whole->large.memory);
    free(whole->subtrees.memory);
    if (!ok)
        bvh_free(build->bvh);
    return ok;
}

bool bvh_build(Bvh *bvh, const Triangles *triangles, const BvhSettings *settings, ThreadPool *pool,
               Error *error)
{
    Whole whole = {.build = {.bvh = bvh, .total = (uint32_t)triangles->count},
                   .triangles = triangles,
                   .pool = pool};
    return build_whole(&whole, settings, error);
}

bool bvh_build_boxes(Bvh *bvh, const BoxArray *boxes, const BvhSettings *settings, ThreadPool *pool,
                     Error *error)
{
    Whole whole = {
        .build = {.bvh = bvh, .total = boxes->count}, .boxes = boxes->boxes, .pool = pool};
    return build_whole(&whole, settings, error);
}

void bvh_free(Bvh *bvh)
{
    free(bvh->nodes);
    free(bvh->order);
    *bvh = (Bvh){0};
}
