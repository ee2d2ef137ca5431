// SPDX-License-Identifier: MIT
// The simplest search, for GPUs and for fp64. One ray traverses the binary tree depth first, and
// enters the nearer child first. A stack holds the children that are still to be entered, with
// their distances.
//
// Invariant: a child is skipped only if the ray misses its box, or enters it beyond search_reach.
// Both are conservative (search.cl), so the hit is the same as without a tree.
#ifndef CLRT_PAIR_CL
#define CLRT_PAIR_CL
#include "accept.cl"

#if !CLRT_WIDE_NODES

static inline Real2 plane_distances(global const BvhPair *node, uint2 plane, Real inverse,
                                    Real offset)
{
    global const float *planes = node->planes[plane.x][plane.y];
    return fma((Real2)(planes[0], planes[1]), (Real2)(inverse), (Real2)(offset));
}

// Computes the interval [entry, leave] of the ray inside each child's box. The interval is empty if
// the ray misses the box.
static inline void intersect_slabs(global const BvhPair *node, const Search *search, Real reach,
                                   Real2 *entry, Real2 *leave)
{
    const Real3 inverse = search->slabs.inverse;
    const Real3 near = search->slabs.near_offset, far = search->slabs.far_offset;
    const uint x = sign_bit(inverse.x), y = sign_bit(inverse.y), z = sign_bit(inverse.z);
    const Real2 near_x = plane_distances(node, (uint2)(0, x), inverse.x, near.x);
    const Real2 near_y = plane_distances(node, (uint2)(1, y), inverse.y, near.y);
    const Real2 near_z = plane_distances(node, (uint2)(2, z), inverse.z, near.z);
    const Real2 far_x = plane_distances(node, (uint2)(0, 1 - x), inverse.x, far.x);
    const Real2 far_y = plane_distances(node, (uint2)(1, 1 - y), inverse.y, far.y);
    const Real2 far_z = plane_distances(node, (uint2)(2, 1 - z), inverse.z, far.z);
    *entry = max(max(near_x, near_y), max(near_z, (Real2)(0.0f)));
    *leave = min(min(far_x, far_y), min(far_z, (Real2)(reach)));
}

// Returns a corner relative to the ray's origin, with components in the order of the shear. Reading
// them by axis makes this order free.
static inline Real3 corner_relative(global const float *corner, const Search *search)
{
    return real3_of(corner[search->axes.x] + search->backward.x,
                    corner[search->axes.y] + search->backward.y,
                    corner[search->axes.z] + search->backward.z);
}

// Tests range.y triangles from range.x on. Stops at the first hit if any hit ends the ray.
static inline void intersect_range(const Search *search, uint2 range, Hit *best)
{
    for (uint index = range.x; index < range.x + range.y; index++) {
        global const TriangleData *triangle = &search->tracer->triangles[index];
        const Corners relative = {corner_relative(triangle->a, search),
                                  corner_relative(triangle->b, search),
                                  corner_relative(triangle->c, search)};
        const TriangleName name = {triangle->id, triangle->material & TRIANGLE_MARKS, index};
        if (intersect_triangle(search, &name, &relative, 1, best) &&
            ends_at_any_hit(search->ray->kind))
            return;
    }
}

// The stack of children to enter. A child is stored as 2 * node + child, with the distance at which
// the ray enters it.
typedef struct {
    uint child[BVH_STACK_SIZE];
    Real entry[BVH_STACK_SIZE];
    uint count;
} PairStack;

static inline void push_child(PairStack *stack, uint child, Real entry)
{
    stack->child[stack->count] = child;
    stack->entry[stack->count] = entry;
    stack->count++;
}

// Pushes the children of a node that the ray enters before `reach`, the nearer one last.
static inline void push_children(PairStack *stack, const Search *search, uint node, Real reach)
{
    Real2 entry, leave;
    intersect_slabs(&search->tracer->nodes[node], search, reach, &entry, &leave);
    const bool hits_first = entry.x <= leave.x, hits_second = entry.y <= leave.y;
    const bool second_nearer = entry.y < entry.x;
    if (hits_second && !second_nearer)
        push_child(stack, 2 * node + 1, entry.y);
    if (hits_first)
        push_child(stack, 2 * node, entry.x);
    if (hits_second && second_nearer)
        push_child(stack, 2 * node + 1, entry.y);
}

static inline void traverse_pairs(const Search *search, Hit *best)
{
    const Tracer *tracer = search->tracer;
    PairStack stack;
    stack.count = 0;
    push_children(&stack, search, 0, search_reach(search, best));
    if (CLRT_STATISTICS)
        tracer->tally->box_tests += 2;
    while (stack.count > 0) {
        stack.count--;
        if (stack.entry[stack.count] > search_reach(search, best))
            continue;
        const uint child = stack.child[stack.count];
        const uint first = tracer->nodes[child >> 1].first[child & 1];
        const uint count = tracer->nodes[child >> 1].count[child & 1];
        if (count == 0) {
            push_children(&stack, search, first, search_reach(search, best));
            if (CLRT_STATISTICS)
                tracer->tally->box_tests += 2;
            continue;
        }
        intersect_range(search, (uint2)(first, count), best);
        if (CLRT_STATISTICS)
            tracer->tally->triangle_tests += count;
        if (ends_at_any_hit(search->ray->kind) && best->id != NOTHING)
            return;
    }
}

static void search_pairs(const Tracer *tracer, const Ray *ray, Hit *best)
{
    const Search search = search_along(tracer, ray, best->t);
    if (CLRT_BVH && tracer->frame->uses_bvh) {
        traverse_pairs(&search, best);
        return;
    }
    intersect_range(&search, (uint2)(0, tracer->frame->triangle_count), best);
    if (CLRT_STATISTICS)
        tracer->tally->triangle_tests += tracer->frame->triangle_count;
}

#endif
#endif
