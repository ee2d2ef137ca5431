// SPDX-License-Identifier: MIT
// Numbers the inner nodes in the order of the tree and rounds their children's boxes outward.
#include "accel/flat_tree.h"

#include <math.h>

uint32_t flat_tree_size(const Bvh *bvh)
{
    if (bvh->node_count <= 1)
        return bvh->node_count;
    return bvh->node_count - bvh->leaf_count;
}

static float largest_coordinate(const Box *box)
{
    float largest = 0;
    for (int axis = 0; axis < 3; axis++)
        largest = fmaxf(largest, fmaxf(fabsf(box->low[axis]), fabsf(box->high[axis])));
    return largest;
}

static float rounded_down(double value)
{
    const float nearest = (float)value;
    return (double)nearest <= value ? nearest : nextafterf(nearest, -INFINITY);
}

static float rounded_up(double value)
{
    return -rounded_down(-value);
}

static void write_planes(BvhPair *pair, int child, const Box *box)
{
    const double slack = (double)BVH_SLACK * (double)largest_coordinate(box);
    for (int axis = 0; axis < 3; axis++) {
        pair->planes[axis][0][child] = rounded_down((double)box->low[axis] - slack);
        pair->planes[axis][1][child] = rounded_up((double)box->high[axis] + slack);
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

static void write_child(BvhPair *pair, int child, const BvhNode *node, uint32_t inner_number)
{
    write_planes(pair, child, &node->box);
    pair->count[child] = node->count;
    pair->first[child] = node->count > 0 ? node->first : inner_number;
}

// Inner nodes are numbered in the order the builder divided them.
static void write_inner(BvhPair *nodes, const Bvh *bvh)
{
    for (uint32_t i = 0; i < bvh->node_count; i++) {
        const BvhNode *node = &bvh->nodes[i];
        if (node->count > 0)
            continue;
        for (uint32_t side = 0; side < 2; side++) {
            const BvhNode *child = &bvh->nodes[node->first + side];
            write_child(&nodes[node->inner], (int)side, child, child->inner);
        }
    }
}

void flat_tree_write(BvhPair *nodes, const Bvh *bvh)
{
    if (bvh->node_count == 0)
        return;
    if (bvh->nodes[0].count > 0) {
        write_child(&nodes[0], 0, &bvh->nodes[0], 0);
        write_missing(&nodes[0], 1);
        return;
    }
    write_inner(nodes, bvh);
}
