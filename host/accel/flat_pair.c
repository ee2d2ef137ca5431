// SPDX-License-Identifier: MIT
// Numbers the inner nodes depth first. The depth of the tree bounds the recursion.
#include "accel/flat_parts.h"

#include <stdlib.h>
#include <string.h>

// Returns the number of pairs: one per inner node, and one if the root is a leaf.
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
        triangle->normals = flat->looks[number].normals;
        const uint8_t *corners = triangles_order(triangles, number)->places;
        memcpy(triangle->a, triangles_corner(triangles, number, corners[0]), sizeof triangle->a);
        memcpy(triangle->b, triangles_corner(triangles, number, corners[1]), sizeof triangle->b);
        memcpy(triangle->c, triangles_corner(triangles, number, corners[2]), sizeof triangle->c);
    }
}

bool flat_pair_make(FlatScene *flat, const FlatSource *source, Error *error)
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
