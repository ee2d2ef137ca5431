// SPDX-License-Identifier: MIT
// Inner nodes keep the order in which the builder divided them.
#include "accel/flat_pair.h"

#include "accel/slack.h"

#include <stdlib.h>
#include <string.h>

uint32_t flat_pair_count(const Bvh *bvh)
{
    if (bvh->node_count <= 1)
        return bvh->node_count;
    return bvh->node_count - bvh->leaf_count;
}

static void write_planes(BvhPair *pair, int child, const Box *box)
{
    const Box grown = slack_grow(box);
    for (int axis = 0; axis < 3; axis++) {
        pair->planes[axis][0][child] = grown.low[axis];
        pair->planes[axis][1][child] = grown.high[axis];
    }
}

// A child that is not there: no ray is ever between these planes.
static void write_missing(BvhPair *pair, int child)
{
    for (int axis = 0; axis < 3; axis++) {
        pair->planes[axis][0][child] = 0x1p100f;
        pair->planes[axis][1][child] = -0x1p100f;
    }
    pair->count[child] = 1;
}

static void write_child(BvhPair *pair, int child, const BvhNode *node)
{
    write_planes(pair, child, &node->box);
    pair->count[child] = node->count;
    pair->first[child] = node->count > 0 ? node->first : node->inner;
}

static void write_inner(BvhPair *pairs, const Bvh *bvh)
{
    for (uint32_t i = 0; i < bvh->node_count; i++) {
        const BvhNode *node = &bvh->nodes[i];
        if (node->count > 0)
            continue;
        for (uint32_t side = 0; side < 2; side++)
            write_child(&pairs[node->inner], (int)side, &bvh->nodes[node->first + side]);
    }
}

void flat_pair_write(BvhPair *pairs, const Bvh *bvh)
{
    if (bvh->node_count == 0)
        return;
    if (bvh->nodes[0].count > 0) {
        pairs[0] = (BvhPair){0};
        write_child(&pairs[0], 0, &bvh->nodes[0]);
        write_missing(&pairs[0], 1);
        return;
    }
    write_inner(pairs, bvh);
}

static void place_triangles(FlatScene *flat, const FlatSource *source)
{
    const uint32_t *order = source->bvh->order;
    for (uint32_t place = 0; place < flat->triangle_count; place++) {
        const uint32_t number = order == NULL ? place : order[place];
        const float(*corners)[3] = (const float(*)[3])source->triangles->corners[number];
        TriangleData *triangle = &flat->triangles[place];
        triangle->id = flat->sphere_count + number;
        triangle->material = flat->looks[number].material;
        triangle->normals = flat->looks[number].normals;
        memcpy(triangle->a, corners[0], sizeof triangle->a);
        memcpy(triangle->b, corners[1], sizeof triangle->b);
        memcpy(triangle->c, corners[2], sizeof triangle->c);
    }
}

bool flat_pair_make(FlatScene *flat, const FlatSource *source, Error *error)
{
    flat->node_count = flat_pair_count(source->bvh);
    flat->pairs = memory_raw(flat->node_count, sizeof *flat->pairs, error);
    flat->triangles = memory_raw(flat->triangle_count, sizeof *flat->triangles, error);
    if (flat->pairs == NULL || flat->triangles == NULL)
        return false;
    flat_pair_write(flat->pairs, source->bvh);
    place_triangles(flat, source);
    free(flat->looks);
    flat->looks = NULL;
    return true;
}
