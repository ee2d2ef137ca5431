// SPDX-License-Identifier: MIT
// Tests that the nodes of the wide tree have the smallest possible sum of surface areas.
#include "unit/cmocka_all.h"

#include "accel/bvh.h"
#include "accel/wide_tree.h"
#include "unit/random.h"

#include <math.h>

#define ITEMS 100

static const Bvh *binary;

static double half_area(const Box *box)
{
    const double x = (double)box->high[0] - (double)box->low[0];
    const double y = (double)box->high[1] - (double)box->low[1];
    const double z = (double)box->high[2] - (double)box->low[2];
    return x * y + y * z + z * x;
}

// The binary nodes that one wide node has as children.
typedef struct {
    uint32_t nodes[WIDE];
    uint32_t count;
} Children;

static double smallest_sum(uint32_t number);

// Tries all ways to open the children from `first` on. Returns the smallest sum below them.
static double smallest_below(const Children *children, uint32_t first)
{
    double sum = 0;
    for (uint32_t i = 0; first == children->count && i < children->count; i++)
        sum += smallest_sum(children->nodes[i]);
    if (first == children->count)
        return sum;
    const double kept = smallest_below(children, first + 1);
    const BvhNode *node = &binary->nodes[children->nodes[first]];
    if (node->count > 0 || children->count == WIDE)
        return kept;
    Children opened = *children;
    opened.nodes[first] = node->first;
    opened.nodes[opened.count++] = node->first + 1;
    return fmin(kept, smallest_below(&opened, first));
}

// Returns the smallest sum of the areas of a wide node for this binary node and of all wide nodes
// below it.
static double smallest_sum(uint32_t number)
{
    const BvhNode *node = &binary->nodes[number];
    const Children children = {{node->first, node->first + 1}, 2};
    return node->count > 0 ? 0 : half_area(&node->box) + smallest_below(&children, 0);
}

// Returns the areas of all children that are nodes.
static double sum_of_children(const WideTree *tree)
{
    double sum = 0;
    for (uint32_t i = 0; i < tree->node_count * WIDE; i++) {
        const BvhWide *node = &tree->nodes[i / WIDE];
        Box box;
        for (int axis = 0; axis < 3; axis++) {
            box.low[axis] = node->planes[axis][0][i % WIDE];
            box.high[axis] = node->planes[axis][1][i % WIDE];
        }
        if (i % WIDE < node->child_count && (node->child[i % WIDE] & WIDE_LEAF) == 0)
            sum += half_area(&box);
    }
    return sum;
}

TEST(nodes_have_the_smallest_sum_of_areas)
{
    uint64_t random = 1;
    for (int round = 0; round < 20; round++) {
        Error error = {0};
        Box boxes[ITEMS];
        for (int i = 0; i < ITEMS; i++)
            for (int axis = 0; axis < 3; axis++) {
                boxes[i].low[axis] = (float)random_between(&random, -1, 0.9);
                boxes[i].high[axis] = boxes[i].low[axis] + (float)random_between(&random, 0, 0.1);
            }
        Bvh bvh;
        const BvhSettings settings = {BVH_SAH, LEAVES_BLOCKS};
        assert_true(bvh_build_boxes(&bvh, &(BoxArray){boxes, ITEMS}, &settings, NULL, &error));
        WideTree tree = {.bvh = &bvh, .leaf_bits = WIDE_LEAF};
        assert_true(wide_tree_make(&tree, ITEMS, &error));
        binary = &bvh;
        const double sum = half_area(&bvh.nodes[0].box) + sum_of_children(&tree);
        assert_true(fabs(sum / smallest_sum(0) - 1) < 0.001); // boxes grow by BVH_SLACK
        wide_tree_free(&tree);
        bvh_free(&bvh);
    }
}
