// SPDX-License-Identifier: MIT
// Tests the guarantees of both builders for any set of triangles.
#include "accel/bvh.h"

#include "unit/cmocka_all.h"
#include "unit/triangle_sets.h"

// Every builder with every kind of leaves.
static const BvhSettings settings[] = {{BVH_SAH, LEAVES_SINGLE},
                                       {BVH_SAH, LEAVES_BLOCKS},
                                       {BVH_MIDPOINT, LEAVES_SINGLE},
                                       {BVH_MIDPOINT, LEAVES_BLOCKS}};
#define SETTINGS (sizeof settings / sizeof settings[0])

static Bvh built(const Triangles *triangles, const BvhSettings *how, uint32_t threads)
{
    Bvh bvh;
    Error error = {0};
    ThreadPool *pool = thread_pool_open(threads);
    if (!bvh_build(&bvh, triangles, how, pool, &error))
        fail_msg("%s", error.text);
    thread_pool_close(pool);
    return bvh;
}

static bool box_holds(const Box *outer, const float point[3])
{
    for (int axis = 0; axis < 3; axis++)
        if (!(outer->low[axis] <= point[axis] && point[axis] <= outer->high[axis]))
            return false;
    return true;
}

// Checks boxes, children and leaves of a subtree by recursion. Returns the subtree's number of
// levels.
static uint32_t check_node(const Bvh *bvh, const Triangles *triangles, uint32_t number,
                           unsigned *seen)
{
    const BvhNode *node = &bvh->nodes[number];
    for (uint32_t place = node->first; place < node->first + node->count; place++) {
        seen[bvh->order[place]]++;
        for (int corner = 0; corner < 3; corner++)
            assert_true(
                box_holds(&node->box, triangles_corner(triangles, bvh->order[place], corner)));
    }
    if (node->count > 0)
        return 1;
    uint32_t levels = 0;
    for (uint32_t child = node->first; child < node->first + 2; child++) {
        assert_true(box_holds(&node->box, bvh->nodes[child].box.low));
        assert_true(box_holds(&node->box, bvh->nodes[child].box.high));
        const uint32_t below = check_node(bvh, triangles, child, seen);
        levels = below > levels ? below : levels;
    }
    return levels + 1;
}

static void check_tree(const Triangles *triangles, const BvhSettings *how)
{
    FREED_BY(bvh_free) Bvh bvh = built(triangles, how, 1);
    unsigned *seen = calloc(triangles->count, sizeof *seen);
    assert_non_null(seen);
    assert_int_equal(check_node(&bvh, triangles, 0, seen), bvh.depth);
    assert_true(bvh.depth <= BVH_MAX_DEPTH);
    assert_int_equal(bvh.node_count, 2 * bvh.leaf_count - 1);
    for (size_t i = 0; i < triangles->count; i++)
        assert_int_equal(seen[i], 1);
    free(seen);
}

TEST(every_triangle_is_in_one_leaf_inside_nested_boxes)
{
    static const size_t counts[] = {1, 2, 3, 5, 9, 1000, 50000};
    for (int set = 0; set < SET_KINDS; set++)
        for (size_t i = 0; i < sizeof counts / sizeof counts[0]; i++) {
            FREED_BY(triangles_free)
            Triangles triangles = triangle_set((TriangleSet)set, counts[i]);
            for (size_t how = 0; how < SETTINGS; how++)
                check_tree(&triangles, &settings[how]);
        }
}

// Compares the subtrees below one node of two trees.
static void expect_same(const Bvh *one, const Bvh *two, uint32_t number)
{
    const BvhNode *a = &one->nodes[number], *b = &two->nodes[number];
    assert_memory_equal(a, b, sizeof *a);
    if (a->count > 0)
        return;
    expect_same(one, two, a->first);
    expect_same(one, two, a->first + 1);
}

// The trees are so large that the threads also share the division of the upper nodes.
TEST(any_number_of_threads_builds_the_same_tree)
{
    for (int set = 0; set < SET_KINDS; set++) {
        FREED_BY(triangles_free) Triangles triangles = triangle_set((TriangleSet)set, 150000);
        for (size_t how = 0; how < SETTINGS; how++) {
            FREED_BY(bvh_free) Bvh one = built(&triangles, &settings[how], 1);
            for (uint32_t threads = 1; threads <= 3; threads++) {
                FREED_BY(bvh_free) Bvh other = built(&triangles, &settings[how], threads);
                assert_int_equal(one.node_count, other.node_count);
                expect_same(&one, &other, 0);
                assert_memory_equal(one.order, other.order, triangles.count * sizeof *one.order);
            }
        }
    }
}

TEST(sah_leaves_stay_small_even_for_equal_triangles)
{
    FREED_BY(triangles_free) Triangles triangles = triangle_set(SET_EQUAL, 10000);
    FREED_BY(bvh_free) Bvh bvh = built(&triangles, &settings[0], 1);
    assert_true(bvh.largest_leaf <= 8);
}

TEST(no_triangles_make_no_tree)
{
    Triangles none = {0};
    Bvh bvh = built(&none, &settings[0], 1);
    assert_int_equal(bvh.node_count, 0);
    bvh_free(&bvh);
    bvh_free(&bvh);
}

// Counts the inner nodes of each depth by recursion.
static void count_inner(const Bvh *bvh, uint32_t number, uint32_t depth,
                        uint32_t counts[BVH_MAX_DEPTH])
{
    if (bvh->nodes[number].count > 0)
        return;
    counts[depth]++;
    count_inner(bvh, bvh->nodes[number].first, depth + 1, counts);
    count_inner(bvh, bvh->nodes[number].first + 1, depth + 1, counts);
}

TEST(trees_count_the_inner_nodes_of_every_depth)
{
    FREED_BY(triangles_free) Triangles triangles = triangle_set((TriangleSet)0, 1000);
    FREED_BY(bvh_free) Bvh bvh = built(&triangles, &settings[0], 1);
    uint32_t expected[BVH_MAX_DEPTH] = {0}, sum = 0;
    count_inner(&bvh, 0, 0, expected);
    assert_memory_equal(bvh.inner_counts, expected, sizeof expected);
    for (int depth = 0; depth < BVH_MAX_DEPTH; depth++)
        sum += expected[depth];
    assert_int_equal(sum, bvh.node_count - bvh.leaf_count);
    assert_true(expected[bvh.depth - 2] > 0 && expected[bvh.depth - 1] == 0);
}
