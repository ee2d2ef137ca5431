// SPDX-License-Identifier: MIT
// A beam is up to PACKETS packets that traverse the tree of wide nodes together (compare Wald,
// Slusallek, Benthin and Wagner, "Interactive rendering with coherent ray tracing", 2001). Bounds
// over all rays of the beam cull a node's children, and a block's triangles, for all packets at
// once. Each stack entry stores which packets have rays inside its parent's box. Only these packets
// test their lanes against the entry's own box.
//
// Rays of a beam separate as they descend. If only few lanes enter a subtree, their rays search it
// one by one (wide.cl).
#ifndef CLRT_BEAM_CL
#define CLRT_BEAM_CL
#include "bounds.cl"

#if CLRT_WIDE_NODES

#define NO_AXIS       3
#define ALL_TRIANGLES ((1u << WIDE) - 1)

// The stack stores children as WIDE * node + slot.
typedef struct {
    const Tracer *tracer;
    RayKind kind;
    uint count;
    Packet packets[PACKETS];
    BeamBounds bounds;       // over all rays
    BeamBounds own[PACKETS]; // over each packet's rays, if its bit is set in `bounded`
    uint bounded;
    bool sheared;    // the packets are prepared for tests against triangles
    uint own_block;  // the block of the triangle that all rays start on, or NOTHING
    uint others;     // bits of this block's triangles that the rays may hit
    uint level_axis; // axis of the plane that find_level found, or NO_AXIS
    float level;
    uint live[PACKETS];   // bits of the lanes that search
    float reach[PACKETS]; // upper bound on search_reach in the live lanes
    Hit *hits;            // of the packets
    SpherePairs pairs;    // that wait for their tests
    WideStack stack;
    uint inside[WIDE_STACK_SIZE]; // packets with rays in the parent's box, per child on the stack
} Beam;

// Returns bounds over the packets whose bits are set. At least one bit must be set. For several
// packets, these are the bounds of the whole beam.
static inline const BeamBounds *bounds_of(Beam *beam, uint packets)
{
    if ((packets & (packets - 1)) != 0 || beam->count == 1)
        return &beam->bounds;
    const uint number = lowest_bit(packets);
    if ((beam->bounded & packets) == 0)
        bounds_over(beam->packets, beam->hits, packets, &beam->own[number]);
    beam->bounded |= packets;
    return &beam->own[number];
}

// Prepares the packets for tests against triangles, on first use.
static inline void shear_packets(Beam *beam)
{
    for (uint number = 0; number < beam->count && !beam->sheared; number++)
        packet_shear(&beam->packets[number]);
    beam->sheared = true;
}

static inline float reach_of(const Beam *beam, uint packets)
{
    float reach = 0.0f;
    for (; packets != 0; packets &= packets - 1)
        reach = max(reach, beam->reach[lowest_bit(packets)]);
    return reach;
}

static inline void expand_node(Beam *beam, uint number, uint packets)
{
    global const BvhWide *node = &beam->tracer->nodes[number];
    float8 entry;
    const int8 near =
        children_near(node, bounds_of(beam, packets), reach_of(beam, packets), &entry);
    vstore8((uint8)(packets), 0, beam->inside + beam->stack.count);
    push_children(&beam->stack, entry, near, number * WIDE + (uint8)(0, 1, 2, 3, 4, 5, 6, 7));
    // For arrays of rays that start on no surface, prefetching saves 3 % of the time.
    if (CLRT_RAYS && exceeds_cache(beam->tracer))
        for (uint bits = lane_bits(near); bits != 0; bits &= bits - 1)
            prefetch_child(beam->tracer, node->child[lowest_bit(bits)]);
}

// Returns the lanes whose rays enter the child's box before `reach`.
static inline Mask lanes_in_child(global const BvhWide *node, uint child, const Packet *packet,
                                  const BeamBounds *bounds, Real reach)
{
    const uint x = bounds->negative[0], y = bounds->negative[1];
    const uint z = bounds->negative[2];
    const Real3 i = packet->rays.slabs.inverse;
    const Real3 near = packet->rays.slabs.near_offset, far = packet->rays.slabs.far_offset;
    const Real3 entries = {fma((Real)(node->planes[0][x][child]), i.x, near.x),
                           fma((Real)(node->planes[1][y][child]), i.y, near.y),
                           fma((Real)(node->planes[2][z][child]), i.z, near.z)};
    const Real3 exits = {fma((Real)(node->planes[0][1 - x][child]), i.x, far.x),
                         fma((Real)(node->planes[1][1 - y][child]), i.y, far.y),
                         fma((Real)(node->planes[2][1 - z][child]), i.z, far.z)};
    return entry_distance(entries) <= leaving_distance(exits, reach);
}

// Returns the packets with live lanes that enter the child, and stores these lanes in `bits`.
static inline uint packets_entering(Beam *beam, uint child, uint packets, uint bits[PACKETS])
{
    global const BvhWide *node = &beam->tracer->nodes[child / WIDE];
    uint entering = 0;
    for (; packets != 0; packets &= packets - 1) {
        const uint number = lowest_bit(packets);
        const Mask inside =
            lanes_in_child(node, child % WIDE, &beam->packets[number], &beam->bounds,
                           search_reach(&beam->packets[number].rays, &beam->hits[number]));
        bits[number] = lane_bits(inside) & beam->live[number];
        entering |= bits[number] != 0 ? 1u << number : 0;
        if (CLRT_STATISTICS)
            beam->tracer->tally->box_tests += popcount(beam->live[number]);
    }
    return entering;
}

// If the beam's rays end at any hit, the packet's lanes that have a hit stop searching. Otherwise,
// updates the packet's reach.
static inline void update_packet(Beam *beam, uint number)
{
    const Hit *hit = &beam->hits[number];
    if (ends_at_any_hit(beam->kind)) {
        beam->live[number] &= lane_bits(hit->id == NOTHING);
        return;
    }
    const Real reach = search_reach(&beam->packets[number].rays, hit);
    beam->reach[number] = highest(lanes_of(beam->live[number]) ? reach : (Real)(0.0f));
}

// Returns the triangles of the block whose corners all have the coordinate `level` on the axis.
static inline int8 lie_level(global const TriangleBlock *block, uint axis, float level)
{
    return block_row(block, 0, axis) == level && block_row(block, 1, axis) == level &&
           block_row(block, 2, axis) == level;
}

// Returns the bits of the block's triangles that the rays may hit.
static inline uint triangles_beside(const Beam *beam, uint number)
{
    global const TriangleBlock *block = beam->tracer->triangles + number;
    if (number == beam->own_block)
        return beam->others;
    if (beam->level_axis == NO_AXIS)
        return ALL_TRIANGLES;
    const int8 level = lie_level(block, beam->level_axis, beam->level);
    return lane_bits(vload8(0, block->id) != NOTHING && !level);
}

// Tests the block's triangles in `others` against the given lanes of the given packets. At least
// one packet must be given. Returns whether a hit changed.
static NOT_INLINE bool intersect_beam_block(Beam *beam, uint block, uint others, uint packets,
                                            const uint bits[PACKETS])
{
    const BlockPlace start = block_start(beam->tracer, block);
    const uint near =
        others & triangles_near(start.block, bounds_of(beam, packets), reach_of(beam, packets));
    bool any = false;
    if (near == 0)
        return false;
    shear_packets(beam);
    for (; packets != 0; packets &= packets - 1) {
        const uint number = lowest_bit(packets);
        Hit hit = read_hit(&beam->hits[number]);
        if (CLRT_STATISTICS)
            beam->tracer->tally->triangle_tests += WIDE * popcount(bits[number]);
        if (!intersect_packet_block(&start, &beam->packets[number], bits[number], near, &hit))
            continue;
        beam->hits[number] = read_hit(&hit);
        update_packet(beam, number);
        any = true;
    }
    return any;
}

// Pairs a block of spheres with the given lanes of the given packets. Returns whether a hit or its
// bound changed.
static NOT_INLINE bool intersect_beam_spheres(Beam *beam, uint child, uint packets,
                                              const uint bits[PACKETS])
{
    uint any = 0;
    for (; packets != 0; packets &= packets - 1) {
        const uint number = lowest_bit(packets);
        beam->pairs.changed[number] = 0;
        pair_lanes(&beam->pairs, number, bits[number], child);
        any |= beam->pairs.changed[number];
        if (beam->pairs.changed[number] != 0)
            update_packet(beam, number);
    }
    return any != 0;
}

// Tests a block of spheres, or the triangles in `others` of a block of triangles.
static inline bool intersect_leaf(Beam *beam, uint leaf, uint others, uint packets,
                                  const uint bits[PACKETS])
{
    if (has_spheres(leaf))
        return intersect_beam_spheres(beam, leaf, packets, bits);
    return intersect_beam_block(beam, leaf & ~WIDE_LEAF, others, packets, bits);
}

#endif
#endif
