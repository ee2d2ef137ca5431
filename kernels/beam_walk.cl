// SPDX-License-Identifier: MIT
// Walks the trees with a beam, first the tree over spheres. If all rays start on one triangle, the
// beam skips it. If all rays start on triangles of one plane that is perpendicular to an axis, the
// beam skips the plane's triangles, and the nodes above only such triangles.
#ifndef CLRT_BEAM_WALK_CL
#define CLRT_BEAM_WALK_CL
#include "beam.cl"

#if CLRT_WIDE_NODES

#define BEAM_LANES (PACKETS * CLRT_LANES)

// A subtree is searched ray by ray if at most this many lanes of a beam enter it. The limit is
// higher for DENSE or more triangles, because rays then separate more. Exchanging the two limits
// makes scenes of 6 thousand triangles 9 % slower, and scenes of a million 10 % slower. With 8
// lanes, a test of few lanes wastes less, so the higher limit is 24 lanes instead of 40. For a gear
// with a million triangles, this saves 6 % of the time, for coral.scn 3 %, and for a torus nothing.
// Arrays of rays that start on no surface keep the lower limit. In a scene of 1.3 million
// triangles, a million of these rays then take 16 % less time, although 65 thousand rays take 9 %
// more.
#define MOST_LANES_LEAVING       (3 * BEAM_LANES / 16)
#define MOST_LANES_LEAVING_DENSE ((CLRT_LANES == 8 ? 3 : 5) * BEAM_LANES / 8)
#define DENSE                    300000

// Returns the packets with lanes that still search.
static inline uint packets_searching(const Beam *beam)
{
    uint packets = 0;
    for (uint number = 0; number < beam->count; number++)
        packets |= beam->live[number] != 0 ? 1u << number : 0;
    return packets;
}

// Returns how many lanes of the given packets have their bit set.
static inline uint lanes_in(uint packets, const uint bits[PACKETS])
{
    uint count = 0;
    for (; packets != 0; packets &= packets - 1)
        count += popcount(bits[lowest_bit(packets)]);
    return count;
}

// Searches the subtree of a node with the given lanes of the given packets, ray by ray.
static NOT_INLINE void search_apart(Beam *beam, uint child, uint packets, const uint bits[PACKETS])
{
    if (!has_sphere_tree(beam->tracer) || child < beam->tracer->frame->sphere_root)
        shear_packets(beam);
    for (; packets != 0; packets &= packets - 1) {
        const uint number = lowest_bit(packets);
        intersect_lanes(&beam->packets[number].rays, bits[number], child, &beam->hits[number],
                        &beam->pairs);
        update_packet(beam, number);
    }
}

// Returns whether all triangles below the node lie in the plane that find_level found.
static inline bool lies_in_level(const Beam *beam, uint number)
{
    return beam->level_axis != NO_AXIS &&
           beam->tracer->nodes[number].level[beam->level_axis] == beam->level;
}

// Searches the tree with the root `root`.
static inline void walk_tree(Beam *beam, uint root)
{
    const bool is_free = CLRT_RAYS && plain_kind(beam->kind) == RAY_CAMERA;
    const bool is_dense = !is_free && beam->tracer->frame->triangle_count >= DENSE;
    const uint most_leaving = is_dense ? MOST_LANES_LEAVING_DENSE : MOST_LANES_LEAVING;
    uint searching = packets_searching(beam);
    float reach = reach_of(beam, searching);
    uint slot;
    beam->stack.count = 0;
    expand_node(beam, root, searching);
    while (searching != 0 && pop_child(&beam->stack, reach, &slot)) {
        uint bits[PACKETS];
        const uint child = beam->tracer->nodes[slot / WIDE].child[slot % WIDE];
        const bool is_leaf = (child & WIDE_LEAF) != 0;
        const uint others = is_leaf && !has_spheres(child)
                                ? triangles_beside(beam, child & ~WIDE_LEAF)
                                : ALL_TRIANGLES;
        if (others == 0 || (!is_leaf && lies_in_level(beam, child)))
            continue;
        const uint parents = beam->inside[beam->stack.count] & searching;
        const uint packets = packets_entering(beam, slot, parents, bits);
        if (packets == 0)
            continue;
        if (is_leaf) {
            if (!intersect_leaf(beam, child, others, packets, bits))
                continue;
        } else if (lanes_in(packets, bits) > most_leaving) {
            expand_node(beam, child, packets);
            continue;
        } else {
            search_apart(beam, child, packets, bits);
        }
        searching = packets_searching(beam);
        reach = reach_of(beam, searching);
    }
}

static inline void test_all_blocks(Beam *beam)
{
    uint packets = packets_searching(beam);
    for (uint block = 0; packets != 0 && block * WIDE < beam->tracer->frame->triangle_count;
         block++)
        if (intersect_beam_block(beam, block, triangles_beside(beam, block), packets, beam->live))
            packets = packets_searching(beam);
}

// Returns the index of the triangle that all rays start on, or NOTHING if there is none.
static inline uint shared_own(const Beam *beam, const Ray *rays)
{
    const uint own = lane_uint(&rays->own_index, 0);
    Mask other = 0;
    for (uint number = 0; number < beam->count; number++)
        other = other || rays[number].own_index != own;
    return any_lane(other) ? NOTHING : own;
}

// Returns whether all rays start within rounding of the plane whose points have the coordinate
// `level` on the axis (docs/numerics.md, B16).
static inline bool start_level(const Ray *rays, uint count, uint axis, float level)
{
    Mask apart = 0;
    for (uint number = 0; number < count; number++) {
        const Real start = component(rays[number].origin, (UInt)(axis));
        apart = apart || !(fabs(start - level) <= 15.0f * UNIT_ROUNDOFF * fabs(start));
    }
    return !any_lane(apart);
}

// Returns the bits of the triangles that the rays may hit in the block of their own triangle. Rays
// do not hit their own triangle. If this triangle is perpendicular to an axis and start_level
// returns true, the rays do not hit the block's coplanar triangles either.
static inline uint triangles_beside_own(const Beam *beam, const Ray *rays, uint own)
{
    global const TriangleBlock *block = beam->tracer->triangles + own / WIDE;
    uint others = lane_bits(vload8(0, block->id) != NOTHING) & ~(1u << own % WIDE);
    for (uint axis = 0; axis < 3 && plain_kind(beam->kind) != RAY_CAMERA; axis++) {
        const float level = block->corners[0][axis][own % WIDE];
        const uint flat = lane_bits(lie_level(block, axis, level));
        if ((flat >> own % WIDE & 1) != 0 && start_level(rays, beam->count, axis, level))
            others &= ~flat;
    }
    return others;
}

// Returns the lanes whose own triangle has the coordinate `level` on the axis at all corners.
static inline Mask own_is_level(const Tracer *tracer, UInt own, uint axis, float level)
{
    const Mask known = own != NOTHING;
    const UInt index = known ? own : (UInt)(0);
    const UInt place = (index / WIDE) * WORDS(TriangleBlock) + index % WIDE;
    const Record record = record_at(tracer->triangles, place + axis * WIDE);
    const Real a = record_real(&record, 0), b = record_real(&record, 3 * WIDE);
    return known && a == level && b == level && record_real(&record, 6 * WIDE) == level;
}

// Returns whether all rays start on the plane whose points have the coordinate `level` on the axis,
// from triangles in this plane.
static inline bool leave_level(const Beam *beam, const Ray *rays, uint axis, float level)
{
    Mask apart = 0;
    if (!start_level(rays, beam->count, axis, level))
        return false;
    for (uint number = 0; number < beam->count; number++)
        apart = apart || !own_is_level(beam->tracer, rays[number].own_index, axis, level);
    return !any_lane(apart);
}

// If all rays start on triangles that lie in one plane perpendicular to an axis, stores the axis
// and the plane's coordinate. Such rays hit no triangle of the plane (docs/numerics.md, B16).
static NOT_INLINE void find_level(Beam *beam, const Ray *rays)
{
    const uint first = lane_uint(&rays->own_index, 0);
    if (first == NOTHING || plain_kind(beam->kind) == RAY_CAMERA)
        return;
    global const TriangleBlock *block = beam->tracer->triangles + first / WIDE;
    for (uint axis = 0; axis < 3; axis++) {
        const float level = block->corners[0][axis][first % WIDE];
        if (block->corners[1][axis][first % WIDE] == level &&
            leave_level(beam, rays, axis, level)) {
            beam->level_axis = axis;
            beam->level = level;
        }
    }
}

// Stores which triangles the rays skip. Returns false if the rays skip all triangles of the scene,
// for example if they start on a floor and all other objects are spheres.
static inline bool beam_start(Beam *beam, const Tracer *tracer, const Ray *rays)
{
    beam->tracer = tracer;
    beam->kind = rays->kind;
    const uint own = shared_own(beam, rays);
    beam->own_block = own == NOTHING ? NOTHING : own / WIDE;
    beam->level_axis = NO_AXIS;
    if (own == NOTHING) {
        find_level(beam, rays);
        return CLRT_TRIANGLES && tracer->frame->triangle_count != 0;
    }
    beam->others = triangles_beside_own(beam, rays, own);
    const bool has_tree = CLRT_BVH && tracer->frame->uses_bvh;
    return beam->others != 0 || has_tree || tracer->frame->triangle_count > WIDE;
}

// Prepares the tests against boxes.
static inline void beam_prepare(Beam *beam, const Ray *rays)
{
    for (uint number = 0; number < beam->count; number++) {
        search_boxes(&beam->packets[number].rays, beam->tracer, &rays[number],
                     beam->hits[number].t);
        beam->live[number] = lane_bits(rays[number].active);
    }
    const float reach =
        bounds_over(beam->packets, beam->hits, (1u << beam->count) - 1, &beam->bounds);
    for (uint number = 0; number < PACKETS; number++)
        beam->reach[number] = reach;
    beam->bounded = 0;
    beam->sheared = false;
}

static inline void search_tree(Beam *beam, uint root, bool alone)
{
    if (alone)
        search_apart(beam, root, packets_searching(beam), beam->live);
    else
        walk_tree(beam, root);
}

// Finds hits on spheres. Triangles beyond these hits then do not count.
static inline void search_spheres(Beam *beam, bool alone)
{
    start_pairs(&beam->pairs, beam->tracer, beam->packets->rays.ray, beam->hits);
    search_tree(beam, beam->tracer->frame->sphere_root, alone);
    finish_pairs(&beam->pairs);
    for (uint number = 0; number < beam->count; number++) {
        update_packet(beam, number);
        beam->packets[number].rays.limit = beam->hits[number].t;
    }
}

// Finds the hits of rays: any hits if ends_at_any_hit returns true, else the nearest hits. If the
// scene has a tree and `alone` is set, each ray searches alone. Otherwise, the rays' directions
// must share their signs. The beam's count and hits must be set, and at least one lane must search.
static NOT_INLINE void search_beam(Beam *beam, const Tracer *tracer, const Ray *rays, bool alone)
{
    const bool may_hit_triangles = beam_start(beam, tracer, rays);
    if (!may_hit_triangles && !has_sphere_tree(tracer))
        return;
    beam_prepare(beam, rays);
    if (has_sphere_tree(tracer))
        search_spheres(beam, alone);
    if (!may_hit_triangles)
        return;
    if (!CLRT_BVH || !tracer->frame->uses_bvh)
        test_all_blocks(beam);
    else if (packets_searching(beam) != 0)
        search_tree(beam, 0, alone);
}

#endif
#endif
