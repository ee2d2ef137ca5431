// SPDX-License-Identifier: MIT
// Tests the trees over spheres: they contain each sphere once, and the bounding spheres and boxes
// contain what is below them.
#include "unit/cmocka_all.h"

#include "accel/flat.h"
#include "accel/sphere_blocks.h"
#include "accel/sphere_tree.h"
#include "unit/random.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define SPHERES_MOST 500

static uint64_t random_state;
static bool was_seen[SPHERES_MOST];

static double value_of(float high, float low)
{
    return (double)high + (double)low;
}

static void expect_inside(const SphereData *sphere, const SphereData *bound)
{
    double squares = 0;
    for (int axis = 0; axis < 3; axis++) {
        const double apart = value_of(sphere->center[axis], sphere->center_low[axis]) -
                             value_of(bound->center[axis], bound->center_low[axis]);
        squares += apart * apart;
    }
    assert_true(sqrt(squares) + value_of(sphere->radius, sphere->radius_low) <=
                (double)bound->radius);
}

// Tests the entries from `first` to `end` - 1. The spheres must be inside of `bound`, the smallest
// bounding sphere around them.
static void expect_entries(const FlatScene *flat, uint32_t first, uint32_t end,
                           const SphereData *bound)
{
    for (uint32_t i = first; i < end; i++) {
        const SphereData *entry = &flat->spheres[i];
        if (entry->id == NOTHING) {
            assert_true(entry->next > i + 2 && entry->next <= end);
            expect_entries(flat, i + 1, entry->next, entry);
            i = entry->next - 1;
            continue;
        }
        assert_non_null(bound);
        expect_inside(entry, bound);
    }
}

static FlatScene random_spheres(uint32_t count)
{
    Error error = {0};
    FlatScene flat = {.sphere_count = count, .sphere_entries = count};
    flat.spheres = memory_zeroed(count, sizeof *flat.spheres, &error);
    assert_non_null(flat.spheres);
    for (uint32_t i = 0; i < count; i++) {
        SphereData *sphere = &flat.spheres[i];
        for (int axis = 0; axis < 3; axis++) {
            sphere->center[axis] = (float)random_between(&random_state, -0.5, 0.5);
            sphere->center_low[axis] = sphere->center[axis] * 0x1p-26f;
        }
        sphere->radius = (float)exp2(random_between(&random_state, -20, 0));
        sphere->radius_low = sphere->radius * 0x1p-26f;
        sphere->material = i;
    }
    return flat;
}

TEST(bounding_spheres_contain_each_sphere_once)
{
    random_state = (uint64_t)time(NULL);
    printf("seed %llu\n", (unsigned long long)random_state);
    for (uint32_t count = 5; count < SPHERES_MOST; count += 1 + count / 4) {
        Error error = {0};
        FlatScene flat = random_spheres(count);
        assert_true(sphere_tree_make(&flat, &error));
        expect_entries(&flat, count, flat.sphere_entries, NULL);
        memset(was_seen, 0, sizeof was_seen);
        uint32_t copies = 0;
        for (uint32_t i = count; i < flat.sphere_entries; i++) {
            const SphereData *entry = &flat.spheres[i];
            if (entry->id == NOTHING)
                continue;
            assert_true(entry->id < count && !was_seen[entry->id]);
            assert_int_equal(entry->material, entry->id);
            was_seen[entry->id] = true;
            copies++;
        }
        assert_int_equal(copies, count);
        flat_free(&flat);
    }
}

static const FlatScene *wide_flat;
static const WideTree *wide_tree;

// Tests that the sphere in a slot is the scene's sphere, and that the boxes contain this sphere.
static void expect_slot(const SphereBlock *block, uint32_t slot, const Box *box)
{
    const uint32_t id = block->id[slot];
    assert_in_range(id, 0, wide_flat->sphere_count - 1);
    const SphereData *sphere = &wide_flat->spheres[id];
    const double radius = value_of(sphere->radius, sphere->radius_low);
    assert_false(was_seen[id]);
    was_seen[id] = true;
    assert_true(block->radius[slot] == sphere->radius &&
                block->radius_low[slot] == sphere->radius_low);
    for (int axis = 0; axis < 3; axis++) {
        const double center = value_of(sphere->center[axis], sphere->center_low[axis]);
        assert_true(block->center[axis][slot] == sphere->center[axis] &&
                    block->center_low[axis][slot] == sphere->center_low[axis]);
        assert_true((double)box->low[axis] <= center - radius &&
                    center + radius <= (double)box->high[axis]);
    }
}

// Tests the spheres below a child. `box` is the intersection of the boxes above them.
static void expect_below(uint32_t child, const Box *box)
{
    const SphereData *end = wide_flat->spheres + wide_flat->sphere_count;
    if (child >= WIDE_SPHERES) {
        const SphereBlock *block = (const SphereBlock *)end + (child & ~WIDE_SPHERES);
        uint32_t slot = 0;
        for (; slot < WIDE && block->id[slot] != NOTHING; slot++)
            expect_slot(block, slot, box);
        assert_true(slot > 0);
        for (; slot < WIDE; slot++)
            assert_int_equal(block->id[slot], NOTHING);
        return;
    }
    const BvhWide *node = &wide_tree->nodes[child - wide_tree->root];
    for (uint32_t i = 0; i < node->child_count; i++) {
        Box inside;
        for (int axis = 0; axis < 3; axis++) {
            inside.low[axis] = fmaxf(box->low[axis], node->planes[axis][0][i]);
            inside.high[axis] = fminf(box->high[axis], node->planes[axis][1][i]);
        }
        expect_below(node->child[i], &inside);
    }
}

TEST(boxes_contain_each_sphere_once)
{
    const Box everywhere = {{-INFINITY, -INFINITY, -INFINITY}, {INFINITY, INFINITY, INFINITY}};
    random_state = (uint64_t)time(NULL);
    printf("seed %llu\n", (unsigned long long)random_state);
    for (uint32_t count = TREELESS_SPHERES + 1; count < SPHERES_MOST; count += 1 + count / 4) {
        Error error = {0};
        FlatScene flat = random_spheres(count);
        WideTree tree = {.root = 7};
        const FlatSource source = {.layout = NODES_WIDE,
                                   .has_tree = true,
                                   .builder = count % 2 == 0 ? BVH_SAH : BVH_MIDPOINT};
        assert_true(sphere_blocks_make(&flat, &source, &tree, &error));
        assert_int_equal(flat.sphere_root, 7);
        memset(was_seen, 0, sizeof was_seen);
        wide_flat = &flat;
        wide_tree = &tree;
        expect_below(7, &everywhere);
        for (uint32_t i = 0; i < count; i++)
            assert_true(was_seen[i]);
        wide_tree_free(&tree);
        free(flat.spheres);
    }
}
