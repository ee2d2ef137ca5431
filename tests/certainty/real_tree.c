// SPDX-License-Identifier: MIT
// Coordinates of triangles are at most 1. Boxes are padded by 1e-6, and during a walk also by
// 1e-6 * (1 + |origin|) on each axis.
#include "certainty/real_tree.h"

#include <math.h>
#include <stdlib.h>

#define LEAF_MOST 4
#define PADDING   1e-6

static void include(RealNode *node, const float point[3])
{
    for (int axis = 0; axis < 3; axis++) {
        node->low[axis] = fmin(node->low[axis], (double)point[axis] - PADDING);
        node->high[axis] = fmax(node->high[axis], (double)point[axis] + PADDING);
    }
}

// Computes a node's box. A node of more than LEAF_MOST triangles gets two children with half of the
// triangles each.
static void divide(RealTree *tree, uint32_t number, const FlatScene *flat)
{
    RealNode *node = &tree->nodes[number];
    const uint32_t half = node->count / 2;
    for (int axis = 0; axis < 3; axis++) {
        node->low[axis] = INFINITY;
        node->high[axis] = -INFINITY;
    }
    for (uint32_t i = node->first; i < node->first + node->count; i++) {
        include(node, flat->triangles[i].a);
        include(node, flat->triangles[i].b);
        include(node, flat->triangles[i].c);
    }
    if (node->count <= LEAF_MOST)
        return;
    node->children = tree->node_count;
    tree->node_count += 2;
    tree->nodes[node->children] = (RealNode){.first = node->first, .count = half};
    tree->nodes[node->children + 1] =
        (RealNode){.first = node->first + half, .count = node->count - half};
    divide(tree, node->children, flat);
    divide(tree, node->children + 1, flat);
}

bool real_tree_make(RealTree *tree, const FlatScene *flat, Error *error)
{
    const uint32_t count = flat->triangle_count;
    *tree = (RealTree){0};
    if (count == 0)
        return true;
    tree->nodes = memory_raw(2 * (size_t)count, sizeof *tree->nodes, error);
    if (tree->nodes == NULL)
        return false;
    tree->nodes[0] = (RealNode){.count = count};
    tree->node_count = 1;
    divide(tree, 0, flat);
    return true;
}

void real_tree_free(RealTree *tree)
{
    free(tree->nodes);
    *tree = (RealTree){0};
}

void real_walk_begin(RealWalk *walk, const RealTree *tree, const double origin[3],
                     const double direction[3])
{
    walk->tree = tree;
    walk->count = 0;
    for (int axis = 0; axis < 3; axis++) {
        walk->origin[axis] = origin[axis];
        walk->inverse[axis] = 1 / copysign(fmax(fabs(direction[axis]), 1e-30), direction[axis]);
    }
    if (tree->node_count > 0)
        walk->waiting[walk->count++] = 0;
}

static bool enters(const RealWalk *walk, const RealNode *node, double reach)
{
    double enter = 0, leave = reach;
    for (int axis = 0; axis < 3; axis++) {
        const double padding = PADDING * (fabs(walk->origin[axis]) + 1);
        const double low = (node->low[axis] - padding - walk->origin[axis]) * walk->inverse[axis];
        const double high = (node->high[axis] + padding - walk->origin[axis]) * walk->inverse[axis];
        enter = fmax(enter, fmin(low, high));
        leave = fmin(leave, fmax(low, high));
    }
    return enter <= leave;
}

const RealNode *real_walk_next(RealWalk *walk, double reach)
{
    while (walk->count > 0) {
        const RealNode *node = &walk->tree->nodes[walk->waiting[--walk->count]];
        if (!enters(walk, node, reach))
            continue;
        if (node->children == 0)
            return node;
        walk->waiting[walk->count++] = node->children;
        walk->waiting[walk->count++] = node->children + 1;
    }
    return NULL;
}
