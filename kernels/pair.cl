// SPDX-License-Identifier: MIT
// The simplest search, for GPUs, for fp64, for small pictures, and for CPUs on which packets are
// slow (host/device/kernel_choice.c). One ray traverses the binary tree depth first, and enters the
// nearer child first. A stack holds the pending children with their distances.
//
// Invariant: a child is skipped only if the ray misses the child's box, or enters this box beyond
// search_reach. Both tests are conservative (search.cl), so the hit is the same as without a tree.
#ifndef CLRT_PAIR_CL
#define CLRT_PAIR_CL
#include "accept.cl"

#if !CLRT_WIDE_NODES

// The ray's intervals inside the boxes of the two children. The interval of a missed box is empty.
typedef struct {
    Real2 entry, leave;
} Intervals;

// Narrows the intervals to the slabs of one axis. `planes` has the low and the high planes of both
// children. All planes are loaded, because a GPU reads a whole node faster than selected planes.
static inline Intervals clip_slabs(Intervals inside, global const float planes[2][2], Real inverse,
                                   Real2 offsets)
{
    const Real2 low = (Real2)(planes[0][0], planes[0][1]);
    const Real2 high = (Real2)(planes[1][0], planes[1][1]);
    const bool backward = sign_bit(inverse) != 0;
    const Real2 near = backward ? high : low, far = backward ? low : high;
    inside.entry = max(inside.entry, fma(near, (Real2)(inverse), (Real2)(offsets.x)));
    inside.leave = min(inside.leave, fma(far, (Real2)(inverse), (Real2)(offsets.y)));
    return inside;
}

// Returns the distances at which the ray enters the children's boxes, and INFINITY for boxes that
// it does not enter before `reach`.
static inline Real2 enter_boxes(global const BvhPair *node, const Slabs *slabs, Real reach)
{
    const Real3 near = slabs->near_offset, far = slabs->far_offset;
    Intervals inside = {(Real2)(0.0f), (Real2)(reach)};
    inside = clip_slabs(inside, node->planes[0], slabs->inverse.x, (Real2)(near.x, far.x));
    inside = clip_slabs(inside, node->planes[1], slabs->inverse.y, (Real2)(near.y, far.y));
    inside = clip_slabs(inside, node->planes[2], slabs->inverse.z, (Real2)(near.z, far.z));
    return inside.entry <= inside.leave ? inside.entry : (Real2)(INFINITY);
}

// Returns a corner relative to the ray's origin, with its coordinates in the order of search->axes.
// A CPU reads the coordinates in this order, which makes small scenes a tenth faster. A GPU reads
// 16 bytes at once, which saves 9 registers.
static inline Real3 corner_relative(global const float *corner, const Search *search)
{
    if (CLRT_GPU)
        return axes_ordered(difference(load3(corner), search->ray->origin), &search->axes);
    return real3_of(corner[search->axes.x] + search->backward.x,
                    corner[search->axes.y] + search->backward.y,
                    corner[search->axes.z] + search->backward.z);
}

// Tests range.y triangles, starting at index range.x. If any hit ends the ray, stops after the
// first triangle that is hit.
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

// The children that are still to be visited, as 2 * node + child, and the distances at which the
// ray enters them. A GPU keeps these arrays in memory, and the search's other state in registers.
typedef struct {
    uint child[BVH_STACK_SIZE];
    Real entry[BVH_STACK_SIZE];
} PairStack;

// A place in the tree: triangles [first, first + count) or, if count is 0, the node `first`. {0} is
// the root.
typedef struct {
    uint first, count;
    uint depth; // entries on the stack
} PairPlace;

static inline void push_child(PairStack *stack, PairPlace *place, uint child, Real entry)
{
    stack->child[place->depth] = child;
    stack->entry[place->depth] = entry;
    place->depth++;
}

// Pushes the children that the ray enters, the nearer one last. `entry` has the distances at which
// the ray enters them, and INFINITY for a child that it misses.
static inline void push_children(Real2 entry, PairStack *stack, PairPlace *place)
{
    const uint first = 2 * place->first;
    const bool second_nearer = entry.y < entry.x;
    if (entry.y < INFINITY && !second_nearer)
        push_child(stack, place, first + 1, entry.y);
    if (entry.x < INFINITY)
        push_child(stack, place, first, entry.x);
    if (second_nearer)
        push_child(stack, place, first + 1, entry.y);
}

// Moves from a node to the nearer child, and pushes the other child if the ray enters it. `entry`
// is as in push_children. Returns false if the ray enters neither child.
static inline bool move_to_child(global const Node *nodes, Real2 entry, PairStack *stack,
                                 PairPlace *place)
{
    const uint number = place->first;
    const bool second = entry.y < entry.x;
    const Real nearer = second ? entry.y : entry.x, farther = second ? entry.x : entry.y;
    if (farther < INFINITY)
        push_child(stack, place, 2 * number + !second, farther);
    const uint2 first = (uint2)(nodes[number].first[0], nodes[number].first[1]);
    const uint2 count = (uint2)(nodes[number].count[0], nodes[number].count[1]);
    place->first = second ? first.y : first.x;
    place->count = second ? count.y : count.x;
    return nearer < INFINITY;
}

// Enters a node's children. A GPU keeps the nearer child in registers. On a CPU, small scenes take
// a seventh less time with both children on the stack. Returns whether `place` is now a child.
// Otherwise, the caller must pop the next place.
static inline bool enter_children(global const Node *nodes, Real2 entry, PairStack *stack,
                                  PairPlace *place)
{
    if (CLRT_GPU)
        return move_to_child(nodes, entry, stack, place);
    push_children(entry, stack, place);
    return false;
}

// Pops children until the ray enters one before `reach`, and moves to this child. Returns false if
// the stack has no such child.
static inline bool pop_place(global const Node *nodes, Real reach, const PairStack *stack,
                             PairPlace *place)
{
    while (place->depth > 0) {
        place->depth--;
        if (stack->entry[place->depth] > reach)
            continue;
        const uint child = stack->child[place->depth];
        place->first = nodes[child >> 1].first[child & 1];
        place->count = nodes[child >> 1].count[child & 1];
        return true;
    }
    return false;
}

// Tests the boxes of a node's children, and enters the children within `reach`. Returns
// enter_children's result.
static inline bool descend(const Search *search, Real reach, PairStack *stack, PairPlace *place)
{
    const Tracer *tracer = search->tracer;
    const Real2 entry = enter_boxes(&tracer->nodes[place->first], &search->slabs, reach);
    if (CLRT_STATISTICS)
        tracer->tally->box_tests += 2;
    return enter_children(tracer->nodes, entry, stack, place);
}

static inline void traverse_pairs(const Search *search, Hit *best)
{
    const Tracer *tracer = search->tracer;
    PairStack stack;
    PairPlace place = {0};
    for (;;) {
        if (place.count > 0) {
            intersect_range(search, (uint2)(place.first, place.count), best);
            if (CLRT_STATISTICS)
                tracer->tally->triangle_tests += place.count;
            if (ends_at_any_hit(search->ray->kind) && best->id != NOTHING)
                return;
        } else if (descend(search, search_reach(search, best), &stack, &place)) {
            continue;
        }
        if (!pop_place(tracer->nodes, search_reach(search, best), &stack, &place))
            return;
    }
}

static inline void search_pairs(const Tracer *tracer, const Ray *ray, Hit *best)
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
