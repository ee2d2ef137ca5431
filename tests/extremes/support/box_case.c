// SPDX-License-Identifier: MIT
// Intervals of t as fractions: comparing them by cross-multiplication needs no rounding.
#include "box_case.h"

#include "accel/flat_parts.h"
#include "check.h"
#include "ray_order.h"

#include <stdlib.h>

// above / below, with below > 0; infinite where that is 0.
typedef struct {
    long double above, below;
} Fraction;

static bool is_less(Fraction a, Fraction b)
{
    return a.above * b.below < b.above * a.below;
}

bool box_case_is_met(const TestRay *ray, const Box *box)
{
    Fraction enter = {0, 1}, leave = {1, 0};
    for (int axis = 0; axis < 3; axis++) {
        const long double origin = ray->origin[axis], direction = ray->direction[axis];
        const long double low = (long double)box->low[axis] - origin;
        const long double high = (long double)box->high[axis] - origin;
        if (direction == 0) {
            if (low > 0 || high < 0)
                return false;
            continue;
        }
        const Fraction first = {direction > 0 ? low : -high, fabsl(direction)};
        const Fraction last = {direction > 0 ? high : -low, fabsl(direction)};
        enter = is_less(enter, first) ? first : enter;
        leave = is_less(last, leave) ? last : leave;
    }
    return !is_less(leave, enter);
}

// A root with both boxes as its leaves, grown as those of any tree.
static void write_node(BvhPair *node, const Box boxes[2])
{
    BvhNode nodes[3] = {{.first = 1},
                        {.box = boxes[0], .first = 0, .count = 1},
                        {.box = boxes[1], .first = 1, .count = 1}};
    const Bvh bvh = {.nodes = nodes, .node_count = 3, .leaf_count = 2};
    assert_int_equal(flat_pair_count(&bvh), 1);
    flat_pair_write(node, &bvh);
}

static int compare_classes(const void *first, const void *second)
{
    const BoxCase *a = first, *b = second;
    return (int)ray_order_class(&a->ray) - (int)ray_order_class(&b->ray);
}

// The device's answers for the cases.
static TestHit *trace_cases(RayBatch *batch, const BoxCase *cases, size_t count)
{
    Error error = {0};
    TestRay *rays = memory_raw(count, sizeof *rays, &error);
    BvhPair *nodes = memory_zeroed(count, sizeof *nodes, &error);
    TestHit *hits = memory_raw(count, sizeof *hits, &error);
    require(rays != NULL && nodes != NULL && hits != NULL, &error);
    for (size_t i = 0; i < count; i++) {
        rays[i] = cases[i].ray;
        write_node(&nodes[i], cases[i].boxes);
    }
    ray_batch_boxes(batch, rays, nodes, count, hits);
    free(rays);
    free(nodes);
    return hits;
}

size_t box_case_count_misses(RayBatch *batch, BoxCase *cases, size_t count, size_t *met)
{
    size_t misses = 0;
    qsort(cases, count, sizeof *cases, compare_classes);
    TestHit *hits = trace_cases(batch, cases, count);
    for (size_t i = 0; i < count; i++)
        for (int box = 0; box < 2; box++) {
            if (!box_case_is_met(&cases[i].ray, &cases[i].boxes[box]))
                continue;
            (*met)++;
            misses += (hits[i].id >> box & 1) == 0;
        }
    free(hits);
    return misses;
}
