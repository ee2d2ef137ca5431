// SPDX-License-Identifier: MIT
// Boxes are padded by a millionth of the frame's size and of the distance to the box.
#include "certainty/real_tree.h"

#include <math.h>
#include <stdlib.h>

#define LEAF_MOST 4
#define PADDING   1e-6

typedef struct {
    double key;
    uint32_t place;
} Keyed;

static const float *corner_of(const TriangleData *triangle, int corner)
{
    return corner == 0 ? triangle->a : corner == 1 ? triangle->b : triangle->c;
}

static double middle_of(const TriangleData *triangle, int axis)
{
    return ((double)triangle->a[axis] + (double)triangle->b[axis] + (double)triangle->c[axis]) / 3;
}

static int compare_keys(const void *a, const void *b)
{
    const Keyed *first = a, *second = b;
    return (first->key > second->key) - (first->key < second->key);
}

static void enclose(RealNode *node, const FlatScene *flat, const Keyed *keyed)
{
    for (int axis = 0; axis < 3; axis++) {
        node->low[axis] = INFINITY;
        node->high[axis] = -INFINITY;
        for (uint32_t i = node->first; i < node->first + node->count; i++)
            for (int corner = 0; corner < 3; corner++) {
                const float *point = corner_of(&flat->triangles[keyed[i].place], corner);
                node->low[axis] = fmin(node->low[axis], (double)point[axis] - PADDING);
                node->high[axis] = fmax(node->high[axis], (double)point[axis] + PADDING);
            }
    }
}

static int longest_axis(const RealNode *node)
{
    int longest = 0;
    for (int axis = 1; axis < 3; axis++)
        if (node->high[axis] - node->low[axis] > node->high[longest] - node->low[longest])
            longest = axis;
    return longest;
}

// Children take the next two free nodes. The depth of recursion is logarithmic, because each node
// is halved.
static void divide(RealTree *tree, uint32_t number, const FlatScene *flat, Keyed *keyed)
{
    RealNode *node = &tree->nodes[number];
    const uint32_t first = node->first, count = node->count, half = count / 2;
    enclose(node, flat, keyed);
    if (count <= LEAF_MOST)
        return;
    const int axis = longest_axis(node);
    for (uint32_t i = first; i < first + count; i++)
        keyed[i].key = middle_of(&flat->triangles[keyed[i].place], axis);
    qsort(keyed + first, count, sizeof *keyed, compare_keys);
    const uint32_t children = tree->node_count;
    tree->node_count += 2;
    tree->nodes[children] = (RealNode){.first = first, .count = half};
    tree->nodes[children + 1] = (RealNode){.first = first + half, .count = count - half};
    node->first = children;
    node->count = 0;
    divide(tree, children, flat, keyed);
    divide(tree, children + 1, flat, keyed);
}

bool real_tree_make(RealTree *tree, const FlatScene *flat, Error *error)
{
    const uint32_t count = flat->triangle_count;
    *tree = (RealTree){0};
    if (count == 0)
        return true;
    Keyed *keyed = memory_raw(count, sizeof *keyed, error);
    tree->nodes = memory_raw(2 * (size_t)count, sizeof *tree->nodes, error);
    tree->order = memory_raw(count, sizeof *tree->order, error);
    const bool ok = keyed != NULL && tree->nodes != NULL && tree->order != NULL;
    for (uint32_t i = 0; ok && i < count; i++)
        keyed[i].place = i;
    if (ok) {
        tree->nodes[0] = (RealNode){.count = count};
        tree->node_count = 1;
        divide(tree, 0, flat, keyed);
    }
    for (uint32_t i = 0; ok && i < count; i++)
        tree->order[i] = keyed[i].place;
    free(keyed);
    return ok;
}

void real_tree_free(RealTree *tree)
{
    free(tree->nodes);
    free(tree->order);
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
        if (node->count > 0)
            return node;
        const double toward = walk->inverse[longest_axis(node)];
        walk->waiting[walk->count++] = node->first + (toward > 0);
        walk->waiting[walk->count++] = node->first + !(toward > 0);
    }
    return NULL;
}
