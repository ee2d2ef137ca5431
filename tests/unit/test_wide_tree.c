// SPDX-License-Identifier: MIT
// Tests that the nodes of the wide tree have the smallest possible sum of surface areas, and that
// they store the planes of level items.
#include "unit/cmocka_all.h"

#include "accel/bvh.h"
#include "accel/wide_tree.h"
#include "unit/random.h"

#include <math.h>

#define ITEMS       100
#define LEVEL_ITEMS 1000

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

// Returns the box around all items below a wide node.
static Box items_below(const WideTree *tree, uint32_t number, const Box *boxes)
{
    const BvhWide *node = &tree->nodes[number];
    Box all = {{2, 2, 2}, {-2, -2, -2}};
    for (uint32_t i = 0; i < node->child_count; i++) {
        const uint32_t child = node->child[i];
        const bool is_block = (child & WIDE_LEAF) != 0;
        const ItemRange range = is_block ? tree->blocks[child & ~WIDE_SPHERES] : (ItemRange){0, 1};
        const Box below = is_block ? (Box){{0}, {0}} : items_below(tree, child, boxes);
        for (uint32_t k = 0; k < range.count; k++) {
            const Box *box = is_block ? &boxes[tree->bvh->order[range.first + k]] : &below;
            for (int axis = 0; axis < 3; axis++) {
                all.low[axis] = fminf(all.low[axis], box->low[axis]);
                all.high[axis] = fmaxf(all.high[axis], box->high[axis]);
            }
        }
    }
    return all;
}

// Half of the items lie in the plane z = 0.5.
static void make_level_boxes(Box boxes[LEVEL_ITEMS])
{
    uint64_t random = 2;
    for (int i = 0; i < LEVEL_ITEMS; i++)
        for (int axis = 0; axis < 3; axis++) {
            const bool is_level = axis == 2 && i < LEVEL_ITEMS / 2;
            const float size = (float)random_between(&random, 0.01, 0.1);
            boxes[i].low[axis] = is_level ? 0.5f : (float)random_between(&random, -1, 0.2);
            boxes[i].high[axis] = is_level ? 0.5f : boxes[i].low[axis] + size;
        }
}

// Returns the number of nodes that store a plane. If a node should store another plane, the test
// fails.
static uint32_t check_levels(const WideTree *tree, const Box *boxes)
{
    uint32_t level = 0;
    for (uint32_t number = 0; number < tree->node_count; number++) {
        const BvhWide *node = &tree->nodes[number];
        const Box all = items_below(tree, number, boxes);
        for (int axis = 0; axis < 3; axis++) {
            const bool is_level = all.low[axis] == all.high[axis] && tree->leaf_bits == WIDE_LEAF;
            assert_true(node->level[axis] == (is_level ? all.low[axis] : INFINITY));
            level += node->level[axis] == 0.5f;
        }
    }
    return level;
}

TEST(nodes_store_the_planes_of_level_triangles_but_not_of_spheres)
{
    Error error = {0};
    Box boxes[LEVEL_ITEMS];
    Bvh bvh;
    const BvhSettings settings = {BVH_SAH, LEAVES_BLOCKS};
    make_level_boxes(boxes);
    assert_true(bvh_build_boxes(&bvh, &(BoxArray){boxes, LEVEL_ITEMS}, &settings, NULL, &error));
    WideTree triangles = {.bvh = &bvh, .leaf_bits = WIDE_LEAF};
    WideTree spheres = {.bvh = &bvh, .leaf_bits = WIDE_SPHERES};
    assert_true(wide_tree_make(&triangles, LEVEL_ITEMS, &error));
    assert_true(wide_tree_make(&spheres, LEVEL_ITEMS, &error));
    assert_true(check_levels(&triangles, boxes) > 0);
    assert_int_equal(check_levels(&spheres, boxes), 0);
    wide_tree_free(&triangles);
    wide_tree_free(&spheres);
    bvh_free(&bvh);
}
