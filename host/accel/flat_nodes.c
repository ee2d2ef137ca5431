// SPDX-License-Identifier: MIT
// The pair layout stores the inner nodes of the binary tree in depth-first order.
//
// In the wide layout, one thread collapses the binary tree into nodes of up to eight children
// (wide_tree.c), and then all threads fill the blocks. Nodes and blocks are in depth-first order.
//
// Invariant: a stored box contains the primitives below it and a margin of BVH_SLACK around them.
// The kernels therefore never cull a triangle that their triangle test would accept
// (kernels/search.cl).
#include "accel/flat_nodes.h"

#include "accel/sphere_blocks.h"
#include "accel/wide_tree.h"

#include <stdlib.h>
#include <string.h>

static void include_point(Box *box, const float point[3], float margin)
{
    for (int axis = 0; axis < 3; axis++) {
        box->low[axis] = fminf(box->low[axis], point[axis] - margin);
        box->high[axis] = fmaxf(box->high[axis], point[axis] + margin);
    }
}

Box flat_nodes_bounds(const FlatScene *flat, const FlatSource *source)
{
    Box box = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    const bool has_tree = source->bvh->node_count > 0;
    if (has_tree)
        box = source->bvh->nodes[0].box;
    for (uint32_t i = 0; !has_tree && i < flat->triangle_count; i++)
        for (int corner = 0; corner < 3; corner++)
            include_point(&box, triangles_corner(source->triangles, i, corner), 0);
    for (uint32_t i = 0; i < flat->sphere_count; i++)
        include_point(&box, flat->spheres[i].center, flat->spheres[i].radius);
    return box_grow(&box, SKY_SLACK);
}

// Returns the number of pairs: one per inner node, or one if the root is a leaf.
static uint32_t pair_count(const Bvh *bvh)
{
    return bvh->node_count <= 1 ? bvh->node_count : bvh->node_count - bvh->leaf_count;
}

// Writes an inner node as pairs[number], followed by the nodes below it, depth first. Returns the
// number of pairs written so far.
static uint32_t write_inner(BvhPair *pairs, uint32_t number, const Bvh *bvh, const BvhNode *node)
{
    uint32_t count = number + 1;
    for (int side = 0; side < 2; side++) {
        const BvhNode *child = &bvh->nodes[node->first + (uint32_t)side];
        box_store(pairs[number].planes[0][0], 2, (uint32_t)side, &child->box);
        pairs[number].count[side] = child->count;
        pairs[number].first[side] = child->count > 0 ? child->first : count;
        if (child->count == 0)
            count = write_inner(pairs, count, bvh, child);
    }
    return count;
}

static void write_pairs(BvhPair *pairs, const Bvh *bvh)
{
    if (bvh->node_count == 0)
        return;
    if (bvh->nodes[0].count == 0) {
        write_inner(pairs, 0, bvh, &bvh->nodes[0]);
        return;
    }
    box_store(pairs[0].planes[0][0], 2, 0, &bvh->nodes[0].box);
    box_store(pairs[0].planes[0][0], 2, 1, NULL);
    pairs[0].first[0] = pairs[0].first[1] = 0;
    pairs[0].count[0] = bvh->nodes[0].count;
    pairs[0].count[1] = 1;
}

static void place_triangles(FlatScene *flat, const FlatSource *source)
{
    const Triangles *triangles = source->triangles;
    const uint32_t *order = source->bvh->order;
    for (uint32_t place = 0; place < flat->triangle_count; place++) {
        const uint32_t number = order == NULL ? place : order[place];
        TriangleData *triangle = &flat->triangles[place];
        triangle->id = flat->sphere_count + number;
        triangle->material = flat->looks[number].material;
        triangle->shading = flat->looks[number].shading;
        const uint8_t *corners = triangles_order(triangles, number)->places;
        memcpy(triangle->a, triangles_corner(triangles, number, corners[0]), sizeof triangle->a);
        memcpy(triangle->b, triangles_corner(triangles, number, corners[1]), sizeof triangle->b);
        memcpy(triangle->c, triangles_corner(triangles, number, corners[2]), sizeof triangle->c);
    }
}

bool flat_nodes_make_pairs(FlatScene *flat, const FlatSource *source, Error *error)
{
    flat->node_count = pair_count(source->bvh);
    flat->pairs = memory_raw(flat->node_count, sizeof *flat->pairs, error);
    flat->triangles = memory_raw(flat->triangle_count, sizeof *flat->triangles, error);
    if (flat->pairs == NULL || flat->triangles == NULL)
        return false;
    write_pairs(flat->pairs, source->bvh);
    place_triangles(flat, source);
    free(flat->looks);
    flat->looks = NULL;
    return true;
}

typedef struct {
    FlatScene *flat;
    const FlatSource *source;
    const ItemRange *ranges; // of the blocks
} Filling;

static void fill_block(const Filling *filling, TriangleBlock *block, ItemRange range)
{
    const FlatScene *flat = filling->flat;
    const Triangles *triangles = filling->source->triangles;
    const uint32_t *order = filling->source->bvh->order;
    if (range.count < WIDE)
        memset(block, 0, sizeof *block);
    for (uint32_t i = 0; i < range.count; i++) {
        const uint32_t triangle = order == NULL ? range.first + i : order[range.first + i];
        const CornerOrder *sorted = triangles_order(triangles, triangle);
        for (int corner = 0; corner < 3; corner++) {
            const float *point = triangles_corner(triangles, triangle, sorted->places[corner]);
            for (int axis = 0; axis < 3; axis++)
                block->corners[corner][axis][i] = point[axis];
        }
        block->id[i] =
            (flat->sphere_count + triangle) | (flat->looks[triangle].material & TRIANGLE_MARKS);
    }
    for (uint32_t i = range.count; i < WIDE; i++)
        block->id[i] = NOTHING;
}

static void fill_blocks(void *context, uint32_t first, uint32_t end)
{
    const Filling *filling = context;
    for (uint32_t number = first; number < end; number++)
        fill_block(filling, &filling->flat->blocks[number], filling->ranges[number]);
}

static void unmark_chunk(void *context, uint32_t first, uint32_t end)
{
    const FlatScene *flat = context;
    for (uint32_t i = first; i < end; i++)
        flat->looks[i].material &= ~TRIANGLE_MARKS;
}

static bool make_all(FlatScene *flat, const FlatSource *source, WideTree *trees, Error *error)
{
    WideTree *triangles = &trees[0], *spheres = &trees[1];
    *triangles = (WideTree){.bvh = source->bvh, .leaf_bits = WIDE_LEAF};
    if (!wide_tree_make(triangles, flat->triangle_count, error))
        return false;
    spheres->root = triangles->node_count;
    if (!sphere_blocks_make(flat, source, spheres, error))
        return false;
    flat->node_count = triangles->node_count + spheres->node_count;
    flat->block_count = triangles->block_count;
    flat->wides = memory_raw(flat->node_count, sizeof *flat->wides, error);
    flat->blocks = memory_raw(flat->block_count, sizeof *flat->blocks, error);
    if (flat->wides == NULL || flat->blocks == NULL)
        return false;
    memcpy(flat->wides, triangles->nodes, triangles->node_count * sizeof *flat->wides);
    if (spheres->node_count > 0)
        memcpy(flat->wides + spheres->root, spheres->nodes,
               spheres->node_count * sizeof *flat->wides);
    thread_pool_share(source->pool, flat->block_count, CHUNK_ELEMENTS / WIDE, fill_blocks,
                      &(Filling){flat, source, triangles->blocks});
    return true;
}

bool flat_nodes_make_wide(FlatScene *flat, const FlatSource *source, Error *error)
{
    WideTree trees[2] = {0};
    const bool ok = make_all(flat, source, trees, error);
    wide_tree_free(&trees[0]);
    wide_tree_free(&trees[1]);
    if (ok)
        thread_pool_share(source->pool, flat->triangle_count, CHUNK_ELEMENTS, unmark_chunk, flat);
    return ok;
}
