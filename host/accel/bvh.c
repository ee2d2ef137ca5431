// SPDX-License-Identifier: MIT
// Builds the tree top down. All threads sort the triangles of a large node into grid cells, and the
// caller's thread divides the cells. Each remaining subtree is built by one thread. Every subtree
// has its own node indices, so the tree does not depend on the schedule.
#include "accel/bvh.h"

#include "accel/build.h"
#include "accel/upper.h"

#include <stdlib.h>
#include <string.h>

typedef struct {
    Build build;
    ThreadPool *pool;
    Upper upper;
    BuildItem *items;    // buffers for build_subtree, one per worker
    BuildCounts *counts; // by subtree
} Whole;

static void number_chunk(void *context, uint32_t first, uint32_t end)
{
    const Whole *whole = context;
    for (uint32_t place = first; place < end; place++)
        whole->build.bvh->order[place] = place;
}

static void build_small(void *context, uint32_t number, uint32_t worker)
{
    const Whole *whole = context;
    const BuildTask *root = &whole->upper.subtrees.data[number];
    if (root->count <= SUBTREE_TRIANGLES)
        build_subtree(&whole->build, root, whole->items + 2 * SUBTREE_TRIANGLES * (size_t)worker,
                      &whole->counts[number]);
}

// Builds the subtrees that are too large for the workers' buffers, one after the other.
static bool build_large(Whole *whole, Error *error)
{
    for (uint32_t i = 0; i < whole->upper.subtrees.count; i++) {
        const BuildTask *root = &whole->upper.subtrees.data[i];
        if (root->count <= SUBTREE_TRIANGLES)
            continue;
        BuildItem *items = memory_raw(2 * (size_t)root->count, sizeof *items, error);
        if (items == NULL)
            return false;
        build_subtree(&whole->build, root, items, &whole->counts[i]);
        free(items);
    }
    return true;
}

static bool build_subtrees(Whole *whole, Error *error)
{
    const uint32_t count = (uint32_t)whole->upper.subtrees.count;
    whole->counts = memory_zeroed(count, sizeof *whole->counts, error);
    whole->items = memory_raw(2 * SUBTREE_TRIANGLES * (size_t)thread_pool_size(whole->pool),
                              sizeof *whole->items, error);
    if (whole->counts == NULL || whole->items == NULL || !build_large(whole, error))
        return false;
    thread_pool_run(whole->pool, count, build_small, whole);
    return true;
}

// Upper nodes are listed in the order of division. The reverse loop visits children before parents.
static void count_upper_leaves(const Whole *whole)
{
    for (size_t i = whole->upper.nodes.count; i > 0; i--)
        build_count_leaves(whole->build.bvh, whole->upper.nodes.data[i - 1]);
}

static int compare_numbers(const void *first, const void *second)
{
    const uint32_t *a = first, *b = second;
    return *a < *b ? -1 : 1;
}

static bool finish(const Whole *whole, Error *error)
{
    Bvh *bvh = whole->build.bvh;
    count_upper_leaves(whole);
    bvh->upper_count = (uint32_t)whole->upper.nodes.count;
    bvh->upper = memory_raw(bvh->upper_count, sizeof *bvh->upper, error);
    if (bvh->upper == NULL)
        return false;
    if (bvh->upper_count > 0)
        memcpy(bvh->upper, whole->upper.nodes.data, bvh->upper_count * sizeof *bvh->upper);
    qsort(bvh->upper, bvh->upper_count, sizeof *bvh->upper, compare_numbers);
    bvh->node_count = 1 + 2 * bvh->upper_count;
    for (uint32_t i = 0; i < whole->upper.subtrees.count; i++) {
        const BuildCounts *counts = &whole->counts[i];
        bvh->node_count += counts->node_count;
        bvh->leaf_count += counts->leaf_count;
        bvh->largest_leaf =
            counts->largest_leaf > bvh->largest_leaf ? counts->largest_leaf : bvh->largest_leaf;
        bvh->depth = counts->depth > bvh->depth ? counts->depth : bvh->depth;
    }
    return true;
}

static bool build_all(Whole *whole, BvhBuilder builder, Error *error)
{
    Bvh *bvh = whole->build.bvh;
    const uint32_t total = (uint32_t)whole->build.triangles->count;
    const BuildTask root = {.count = total, .depth = 1};
    bvh->nodes = memory_sparse(2 * (size_t)total - 1, sizeof *bvh->nodes, error);
    bvh->order = memory_raw(total, sizeof *bvh->order, error);
    if (bvh->nodes == NULL || bvh->order == NULL)
        return false;
    thread_pool_share(whole->pool, total, CHUNK_ELEMENTS, number_chunk, whole);
    // The midpoint split is defined on triangles, so it cannot divide cells.
    const bool ok = builder == BVH_MIDPOINT
                        ? array_push(&whole->upper.subtrees, root, error)
                        : upper_divide(&whole->upper, &whole->build, whole->pool, error);
    return ok && build_subtrees(whole, error) && finish(whole, error);
}

bool bvh_build(Bvh *bvh, const Triangles *triangles, const BvhSettings *settings, ThreadPool *pool,
               Error *error)
{
    *bvh = (Bvh){0};
    if (triangles->count == 0)
        return true;
    Whole whole = {
        .build = {.bvh = bvh,
                  .triangles = triangles,
                  .split = settings->builder == BVH_MIDPOINT ? split_midpoint : split_sah,
                  .leaves = settings->leaves},
        .pool = pool};
    const bool ok = build_all(&whole, settings->builder, error);
    upper_free(&whole.upper);
    free(whole.items);
    free(whole.counts);
    if (!ok)
        bvh_free(bvh);
    return ok;
}

void bvh_free(Bvh *bvh)
{
    free(bvh->nodes);
    free(bvh->order);
    free(bvh->upper);
    *bvh = (Bvh){0};
}

// Traverses the tree with an explicit stack, as the kernels do.
typedef struct {
    uint32_t node, depth;
} Visit;

void bvh_count_levels(const Bvh *bvh, uint32_t counts[BVH_MAX_DEPTH])
{
    Visit stack[BVH_STACK_SIZE] = {{0, 0}};
    uint32_t waiting = bvh->node_count > 0 ? 1 : 0;
    memset(counts, 0, BVH_MAX_DEPTH * sizeof *counts);
    while (waiting > 0) {
        const Visit visit = stack[--waiting];
        const BvhNode *node = &bvh->nodes[visit.node];
        if (node->count > 0)
            continue;
        counts[visit.depth]++;
        stack[waiting++] = (Visit){node->first, visit.depth + 1};
        stack[waiting++] = (Visit){node->first + 1, visit.depth + 1};
    }
}
