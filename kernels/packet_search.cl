// SPDX-License-Identifier: MIT
// Traces packets through the tree of wide nodes (Wald, Slusallek, Benthin and Wagner, "Interactive
// rendering with coherent ray tracing", 2001). Bounds over the packet's rays cull a node's
// children (Boulos, Wald and Shirley, "Geometric and arithmetic culling methods for entire ray
// packets", 2006). Each remaining child is tested against all lanes when it is popped.
#ifndef CLRT_PACKET_SEARCH_CL
#define CLRT_PACKET_SEARCH_CL
#include "packet.cl"

#if CLRT_WIDE_NODES

// Fewer rays than this are faster one by one.
#define SMALLEST_PACKET 6

// A packet has diverged when its box tests find fewer lanes inside than this on average. Its rays
// then restart alone. The credit tolerates a poor start.
#define LANES_PER_TEST 2
#define PACKET_CREDIT  64

static inline float8 node_plane(global const BvhWide *node, const Packet *packet, uint axis,
                                uint other)
{
    return vload8(0, node->planes[axis][packet->negative[axis] ^ other]);
}

// Returns the children that some ray of the packet may enter before `reach`.
static inline int8 children_near(global const BvhWide *node, const Packet *packet, float reach,
                                 float8 *entry)
{
    const float8 near_x = entry_bound(node_plane(node, packet, 0, 0), packet, 0);
    const float8 near_y = entry_bound(node_plane(node, packet, 1, 0), packet, 1);
    const float8 near_z = entry_bound(node_plane(node, packet, 2, 0), packet, 2);
    const float8 far_x = leave_bound(node_plane(node, packet, 0, 1), packet, 0);
    const float8 far_y = leave_bound(node_plane(node, packet, 1, 1), packet, 1);
    const float8 far_z = leave_bound(node_plane(node, packet, 2, 1), packet, 2);
    *entry = max(max(near_x, near_y), max(near_z, (float8)(0.0f)));
    return *entry <= min(min(far_x, far_y), min(far_z, (float8)(reach)));
}

// Returns the lanes whose rays enter the child's box before their current hit.
static inline Mask lanes_in_child(global const BvhWide *node, uint child, const Packet *packet,
                                  Real reach)
{
    const uint x = packet->negative[0], y = packet->negative[1], z = packet->negative[2];
    const Real3 i = packet->rays.slabs.inverse;
    const Real3 near = packet->rays.slabs.near_offset, far = packet->rays.slabs.far_offset;
    const Real near_x = fma((Real)(node->planes[0][x][child]), i.x, near.x);
    const Real near_y = fma((Real)(node->planes[1][y][child]), i.y, near.y);
    const Real near_z = fma((Real)(node->planes[2][z][child]), i.z, near.z);
    const Real far_x = fma((Real)(node->planes[0][1 - x][child]), i.x, far.x);
    const Real far_y = fma((Real)(node->planes[1][1 - y][child]), i.y, far.y);
    const Real far_z = fma((Real)(node->planes[2][1 - z][child]), i.z, far.z);
    const Real entry = max(max(near_x, near_y), max(near_z, (Real)(0.0f)));
    return entry <= min(min(far_x, far_y), min(far_z, reach));
}

// The state of a packet's search. The stack stores children as WIDE * node + slot.
typedef struct {
    const Packet *packet;
    WideStack stack;
    Mask searching; // lanes not yet ended by a shadow ray's hit
    float farthest; // largest hit distance of the searching lanes
    int credit;
    Hit *best;
} PacketSearch;

static inline void expand_node(PacketSearch *search, uint number)
{
    global const BvhWide *node = &search->packet->rays.tracer->nodes[number];
    float8 entry;
    const int8 near = children_near(node, search->packet, search->farthest, &entry);
    push_children(&search->stack, entry, near, number * WIDE + (uint8)(0, 1, 2, 3, 4, 5, 6, 7));
}

// Returns the lanes that enter the child.
static inline uint lanes_entering(PacketSearch *search, uint child)
{
    const Tracer *tracer = search->packet->rays.tracer;
    global const BvhWide *node = &tracer->nodes[child / WIDE];
    const Mask inside = lanes_in_child(node, child % WIDE, search->packet, search->best->t);
    const uint bits = lane_bits(search->searching && inside);
    search->credit += (int)popcount(bits) - LANES_PER_TEST;
    if (CLRT_STATISTICS)
        tracer->tally->box_tests += lane_count(search->searching);
    return bits;
}

static inline void update_lanes(PacketSearch *search, bool is_shadow)
{
    if (is_shadow)
        search->searching = search->searching && search->best->id == NOTHING;
    search->farthest = highest(search->searching ? search->best->t : (Real)(0.0f));
}

// Returns the remaining lanes if the packet is abandoned, else 0.
static inline uint traverse_packet(const Packet *packet, Hit *best)
{
    const Tracer *tracer = packet->rays.tracer;
    const bool is_shadow = packet->rays.ray->kind == RAY_SHADOW;
    PacketSearch search;
    search.packet = packet;
    search.stack.count = 0;
    search.searching = packet->active;
    search.farthest = highest(best->t);
    search.credit = PACKET_CREDIT;
    search.best = best;
    expand_node(&search, 0);
    uint slot;
    while (pop_child(&search.stack, search.farthest, &slot)) {
        const uint bits = lanes_entering(&search, slot);
        if (search.credit < 0)
            return lane_bits(search.searching);
        if (bits == 0)
            continue;
        const uint child = tracer->nodes[slot / WIDE].child[slot % WIDE];
        if ((child & WIDE_LEAF) == 0) {
            expand_node(&search, child);
            continue;
        }
        if (CLRT_STATISTICS)
            tracer->tally->triangle_tests += WIDE * popcount(bits);
        const BlockPlace start = block_start(tracer, child & ~WIDE_LEAF);
        if (!intersect_packet_leaf(&start, packet, bits, search.farthest, best))
            continue;
        update_lanes(&search, is_shadow);
        if (is_shadow && !any_lane(search.searching))
            return 0;
    }
    return 0;
}

// Returns the class that the rays of a packet must share: direction signs and longest axis.
static inline UInt ray_classes(Real3 direction)
{
    const ShearAxes axes = shear_axes(direction);
    return axes.z * 8 + sign_bit(direction.x) * 4 + sign_bit(direction.y) * 2 +
           sign_bit(direction.z);
}

// Returns the remaining lanes, whose rays have to search alone.
static NOT_INLINE uint intersect_packet(const Packet *packet, Hit *best)
{
    const Tracer *tracer = packet->rays.tracer;
    const Mask lanes = packet->active;
    Hit hit = *best;
    uint left = 0;
    if (CLRT_BVH && tracer->frame->uses_bvh) {
        left = traverse_packet(packet, &hit);
    } else {
        for (uint block = 0; block * WIDE < tracer->frame->triangle_count; block++) {
            const BlockPlace start = block_start(tracer, block);
            intersect_packet_block(&start, packet, lanes, INFINITY, &hit);
        }
        if (CLRT_STATISTICS)
            tracer->tally->triangle_tests += tracer->frame->triangle_count * lane_count(lanes);
    }
    best->t = lanes ? hit.t : best->t;
    best->id = lanes ? hit.id : best->id;
    best->index = lanes ? hit.index : best->index;
    return left;
}

// Rays that share signs and longest axis with enough others form a packet; the rest search alone.
// Without a tree there is no traversal, and all rays form packets.
static void search_packets(const Tracer *tracer, const Ray *ray, Hit *best)
{
    const uint all = lane_bits(ray->active);
    const bool has_tree = CLRT_BVH && tracer->frame->uses_bvh;
    const uint smallest = has_tree ? SMALLEST_PACKET : 1;
    uint alone = has_tree && !CLRT_PACKET ? all : 0;
    uint left = all & ~alone;
    const UInt classes = ray_classes(ray->direction);
    while (left != 0) {
        const uint wanted = lane_uint(&classes, lowest_bit(left));
        const uint part = left & lane_bits(classes == wanted);
        left &= ~part;
        if (popcount(part) < smallest) {
            alone |= part;
            continue;
        }
        Packet packet;
        packet_gather(&packet, tracer, ray, part, wanted / 8);
        alone |= intersect_packet(&packet, best);
    }
    if (alone == 0)
        return;
    const Search search = search_along(tracer, ray);
    intersect_lanes(&search, alone, best);
}

#endif
#endif
