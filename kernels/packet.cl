// SPDX-License-Identifier: MIT
// A packet of rays through the tree of wide nodes (Wald, Benthin, Wagner and Slusallek,
// "Interactive rendering with coherent ray tracing", 2001; Boulos, Wald and Benthin, "Adaptive ray
// packet reordering", 2008).
#ifndef CLRT_PACKET_CL
#define CLRT_PACKET_CL
#include "wide.cl"

#if CLRT_WIDE_NODES

// Smaller parts are faster one by one.
#define SMALLEST_PACKET 6

// A packet whose tests of a box against all lanes find fewer lanes inside than this on average has
// fallen apart, and its rays start again alone.  The credit bridges bad luck at the start.
#define LANES_PER_TEST 2
#define PACKET_CREDIT  64

// A block entered by this many lanes or fewer is tested for each alone, all triangles at once.
#define MOST_LANES_ALONE 2

// The rays of a packet that share their signs and their longest axis, with bounds over all of
// them.
typedef struct {
    Search rays; // lanes that take no part copy one that does
    Truth active;
    Real3 ordered_origin; // in the order of the axes
    uint axes[3];
    uint negative[3]; // which plane of an axis the rays meet first
    // Bounds over all lanes: distance to a plane = fma(plane, inverse_low, near_low) ...
    float inverse_low[3], inverse_high[3];
    float near_low[3], near_high[3], far_low[3], far_high[3];
    bool common_origin;
} Packet;

static inline float lowest(Real v)
{
#if CLRT_LANES == 16
    const float8 a = min(v.lo, v.hi);
    const float4 b = min(a.lo, a.hi);
#elif CLRT_LANES == 8
    const float4 b = min(v.lo, v.hi);
#else
    const float4 b = v;
#endif
    const float2 c = min(b.lo, b.hi);
    return min(c.x, c.y);
}

static inline float highest(Real v)
{
#if CLRT_LANES == 16
    const float8 a = max(v.lo, v.hi);
    const float4 b = max(a.lo, a.hi);
#elif CLRT_LANES == 8
    const float4 b = max(v.lo, v.hi);
#else
    const float4 b = v;
#endif
    const float2 c = max(b.lo, b.hi);
    return max(c.x, c.y);
}

// The origin that lies farthest along makes entries early, the one farthest back leaves late.
static inline void packet_bounds(Packet *packet, uint axis, Real origin, Real slack, Real inverse)
{
    const float low = lowest(inverse), high = highest(inverse);
    const bool negative = high < 0.0f;
    const Real ahead = origin + slack, behind = origin - slack;
    const float most = packet->common_origin ? ahead.s0 : highest(ahead);
    const float least = packet->common_origin ? behind.s0 : lowest(behind);
    const float near = negative ? least : most, far = negative ? most : least;
    packet->negative[axis] = negative;
    packet->inverse_low[axis] = low;
    packet->inverse_high[axis] = high;
    packet->near_low[axis] = -near * low;
    packet->near_high[axis] = -near * high;
    packet->far_low[axis] = -far * low;
    packet->far_high[axis] = -far * high;
}

// Component `axis` of all lanes.
static inline Real on_axis(const Real3 *v, uint axis)
{
    return (&v->x)[axis];
}

// The rays have origins o and directions d, longest along the axis z.  Their inverse on that axis
// is the shear's: no other is as long, so the slabs leave it as it is.
static inline void packet_prepare(Packet *packet, Real3 o, Real3 d, uint z)
{
    Search *rays = &packet->rays;
    const uint x = z == 2 ? 0 : z + 1, y = z == 0 ? 2 : z - 1;
    search_slabs(rays, o, d);
    rays->axes = (ShearAxes){x, y, z};
    rays->shear.direction_z = on_axis(&d, z);
    rays->shear.inverse_z = on_axis(&rays->inverse, z);
    rays->shear.shear_x = on_axis(&d, x) * rays->shear.inverse_z;
    rays->shear.shear_y = on_axis(&d, y) * rays->shear.inverse_z;
    packet->ordered_origin = real3_of(on_axis(&o, x), on_axis(&o, y), on_axis(&o, z));
    packet->axes[0] = x;
    packet->axes[1] = y;
    packet->axes[2] = z;
    // Beside the origin's own, the slack that nodes have and boxes of single triangles lack:
    // their coordinates are at most 1.
    const Real slack = BVH_SLACK * (largest_component(o) + 1.0f);
    packet_bounds(packet, 0, o.x, slack, rays->inverse.x);
    packet_bounds(packet, 1, o.y, slack, rays->inverse.y);
    packet_bounds(packet, 2, o.z, slack, rays->inverse.z);
}

// Bounds of the distances at which the rays meet the planes of an axis.
static inline float8 entry_bound(float8 plane, const Packet *packet, uint axis)
{
    const float8 low =
        fma(plane, (float8)(packet->inverse_low[axis]), (float8)(packet->near_low[axis]));
    const float8 high =
        fma(plane, (float8)(packet->inverse_high[axis]), (float8)(packet->near_high[axis]));
    return min(low, high);
}

static inline float8 leave_bound(float8 plane, const Packet *packet, uint axis)
{
    const float8 low =
        fma(plane, (float8)(packet->inverse_low[axis]), (float8)(packet->far_low[axis]));
    const float8 high =
        fma(plane, (float8)(packet->inverse_high[axis]), (float8)(packet->far_high[axis]));
    return max(low, high);
}

static inline float8 node_plane(global const BvhWide *node, const Packet *packet, uint axis,
                                uint other)
{
    return vload8(0, node->planes[axis][packet->negative[axis] ^ other]);
}

// The children that some ray of the packet may meet before `reach`.
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

// The side of the triangles' boxes that the rays meet first, or the other.
static inline float8 block_plane(global const TriangleBlock *block, const Packet *packet, uint axis,
                                 uint other)
{
    const float8 a = block_row(block, 0, axis), b = block_row(block, 1, axis);
    const float8 c = block_row(block, 2, axis);
    return (packet->negative[axis] ^ other) ? max(max(a, b), c) : min(min(a, b), c);
}

// The triangles that some ray of the packet may meet before `reach`: a third of a block's, and
// testing each of them against all lanes costs as much as this.
static inline uint triangles_near(global const TriangleBlock *block, const Packet *packet,
                                  float reach)
{
    const float8 near_x = entry_bound(block_plane(block, packet, 0, 0), packet, 0);
    const float8 near_y = entry_bound(block_plane(block, packet, 1, 0), packet, 1);
    const float8 near_z = entry_bound(block_plane(block, packet, 2, 0), packet, 2);
    const float8 far_x = leave_bound(block_plane(block, packet, 0, 1), packet, 0);
    const float8 far_y = leave_bound(block_plane(block, packet, 1, 1), packet, 1);
    const float8 far_z = leave_bound(block_plane(block, packet, 2, 1), packet, 2);
    const float8 entry = max(max(near_x, near_y), max(near_z, (float8)(0.0f)));
    return lane_bits(entry <= min(min(far_x, far_y), min(far_z, (float8)(reach))));
}

// The lanes whose rays are in the child's box before they reach what they have hit.
static inline Truth lanes_in_child(global const BvhWide *node, uint child, const Packet *packet,
                                   Real reach)
{
    const uint x = packet->negative[0], y = packet->negative[1], z = packet->negative[2];
    const Real3 i = packet->rays.inverse, near = packet->rays.near_offset,
                far = packet->rays.far_offset;
    const Real near_x = fma((Real)(node->planes[0][x][child]), i.x, near.x);
    const Real near_y = fma((Real)(node->planes[1][y][child]), i.y, near.y);
    const Real near_z = fma((Real)(node->planes[2][z][child]), i.z, near.z);
    const Real far_x = fma((Real)(node->planes[0][1 - x][child]), i.x, far.x);
    const Real far_y = fma((Real)(node->planes[1][1 - y][child]), i.y, far.y);
    const Real far_z = fma((Real)(node->planes[2][1 - z][child]), i.z, far.z);
    const Real entry = max(max(near_x, near_y), max(near_z, (Real)(0.0f)));
    return entry <= min(min(far_x, far_y), min(far_z, reach));
}

static inline Real3 splat_corner(global const TriangleBlock *block, uint corner, uint place)
{
    return real3_of(block->corners[corner][0][place], block->corners[corner][1][place],
                    block->corners[corner][2][place]);
}

// The distances at which rays whose lanes are inside the triangle's edges stop on it.
static inline Real packet_distances(global const TriangleBlock *block, uint place,
                                    const Packet *packet, const Corners *sheared,
                                    const Edges *edges, Truth inside, Real reach)
{
    const Ray *ray = packet->rays.ray;
    const bool is_shadow = ray->kind == RAY_SHADOW;
    const uint id = block->id[place];
    const Truth front = edges_face(edges, &packet->rays.shear);
    Truth closed = ray->own != (Count)(id & ~TRIANGLE_TWO_SIDED);
    if ((id & TRIANGLE_TWO_SIDED) == 0)
        closed = closed && (is_shadow ? !front : front);
    const Real t = triangle_depth(sheared, edges) * packet->rays.shear.inverse_z;
    if (ray->kind == RAY_CAMERA)
        return closed && t > 0.0f ? t : INFINITY;
    if (!any_lane(inside && closed && t <= reach))
        return INFINITY;
    const Real error = triangle_depth_error(sheared) * fabs(packet->rays.shear.inverse_z);
    const Corners corners = {splat_corner(block, 0, place), splat_corner(block, 1, place),
                             splat_corner(block, 2, place)};
    const SurfaceRay surface = {ray->surface, front, is_shadow};
    return closed ? surface_ray_distance(&corners, &surface, t, error) : INFINITY;
}

// Corners of a block's triangles relative to an origin that all rays share: [corner][axis].
typedef struct {
    float rows[3][3][WIDE];
} RelativeBlock;

static inline void relative_row(RelativeBlock *relative, global const TriangleBlock *block,
                                uint corner, uint axis, const Packet *packet)
{
    const Real *origin = &packet->ordered_origin.x + axis;
    vstore8(vload8(0, block->corners[corner][packet->axes[axis]]) - (*origin).s0, 0,
            relative->rows[corner][axis]);
}

static inline Real3 relative_corner(const RelativeBlock *relative, uint corner, uint place)
{
    return real3_of(relative->rows[corner][0][place], relative->rows[corner][1][place],
                    relative->rows[corner][2][place]);
}

static inline Real3 corner_from(global const TriangleBlock *block, uint corner, uint place,
                                const Packet *packet)
{
    const Real3 o = packet->ordered_origin;
    return real3_of((Real)(block->corners[corner][packet->axes[0]][place]) - o.x,
                    (Real)(block->corners[corner][packet->axes[1]][place]) - o.y,
                    (Real)(block->corners[corner][packet->axes[2]][place]) - o.z);
}

static ALWAYS_INLINE bool test_triangle(global const TriangleBlock *blocks, uint number, uint place,
                                        const Packet *packet, const Corners *relative, Truth lanes,
                                        Hit *best)
{
    const Corners sheared = corners_sheared(relative, &packet->rays.shear);
    const Edges edges = edges_of(&sheared);
    const Truth inside = lanes && edges_contain(&edges);
    if (!any_lane(inside))
        return false;
    global const TriangleBlock *block = blocks + number;
    const Real t = packet_distances(block, place, packet, &sheared, &edges, inside, best->t);
    const Count id = block->id[place] & ~TRIANGLE_TWO_SIDED;
    const Truth precedes = inside && hit_precedes(t, id, best);
    best->t = precedes ? t : best->t;
    best->id = precedes ? id : best->id;
    best->index = precedes ? (Count)(number * WIDE + place) : best->index;
    return any_lane(precedes);
}

static ALWAYS_INLINE bool test_packet_block(const SceneView *scene, uint number,
                                            const Packet *packet, Truth lanes, float reach,
                                            Hit *best)
{
    global const TriangleBlock *block = &scene->triangles[number];
    uint near = triangles_near(block, packet, reach);
    bool changed = false;
    if (near == 0)
        return false;
    if (packet->common_origin) {
        RelativeBlock relative;
        for (uint corner = 0; corner < 3; corner++)
            for (uint axis = 0; axis < 3; axis++)
                relative_row(&relative, block, corner, axis, packet);
        for (; near != 0; near &= near - 1) {
            const uint place = lowest_bit(near);
            const Corners corners = {relative_corner(&relative, 0, place),
                                     relative_corner(&relative, 1, place),
                                     relative_corner(&relative, 2, place)};
            changed |=
                test_triangle(scene->triangles, number, place, packet, &corners, lanes, best);
        }
        return changed;
    }
    for (; near != 0; near &= near - 1) {
        const uint place = lowest_bit(near);
        const Corners corners = {corner_from(block, 0, place, packet),
                                 corner_from(block, 1, place, packet),
                                 corner_from(block, 2, place, packet)};
        changed |= test_triangle(scene->triangles, number, place, packet, &corners, lanes, best);
    }
    return changed;
}

static ALWAYS_INLINE bool test_packet_leaf(const SceneView *scene, uint number,
                                           const Packet *packet, uint bits, float reach, Hit *best)
{
    if (popcount(bits) > MOST_LANES_ALONE)
        return test_packet_block(scene, number, packet, lanes_of(bits), reach, best);
    bool changed = false;
    for (; bits != 0; bits &= bits - 1)
        changed |= test_block(scene->triangles, number, &packet->rays, lowest_bit(bits), best);
    return changed;
}

// Puts the children whose bits are set on the stack, the nearest on top.
static inline void wait_for_children(WideWaiting *waiting, uint bits, const float8 *entry,
                                     uint first)
{
    const float *entries = (const float *)entry;
    const uint start = waiting->count;
    for (; bits != 0; bits &= bits - 1) {
        const uint number = lowest_bit(bits);
        wait_in_order(waiting, start, waiting_child(entries[number], first + number));
    }
}

// Where a packet's search stands.  Children wait as WIDE * node + place.
typedef struct {
    WideWaiting waiting;
    Truth searching; // lanes that a shadow ray's hit has not ended
    float farthest;  // distance of the searching lanes' hits
    int credit;
    Hit *best;
} PacketWalk;

static inline void expand_node(PacketWalk *walk, const SceneView *scene, const Packet *packet,
                               uint number)
{
    float8 entry;
    const int8 near = children_near(&scene->nodes[number], packet, walk->farthest, &entry);
    wait_for_children(&walk->waiting, lane_bits(near), &entry, number * WIDE);
}

// The lanes that go on into the child.
static inline uint lanes_to_child(PacketWalk *walk, const SceneView *scene, const Packet *packet,
                                  uint child, Tally *tally)
{
    global const BvhWide *node = &scene->nodes[child / WIDE];
    const Truth inside = lanes_in_child(node, child % WIDE, packet, walk->best->t);
    const uint bits = lane_bits(walk->searching && inside);
    walk->credit += (int)popcount(bits) - LANES_PER_TEST;
    if (CLRT_STATISTICS)
        tally->box_tests += lane_count(walk->searching);
    return bits;
}

static inline void note_hits(PacketWalk *walk, bool is_shadow)
{
    if (is_shadow)
        walk->searching = walk->searching && walk->best->id == NOTHING;
    walk->farthest = highest(walk->searching ? walk->best->t : (Real)(0.0f));
}

// Returns the lanes left over when the packet is given up.
static inline uint traverse_packet(const SceneView *scene, const Packet *packet, Hit *best,
                                   Tally *tally)
{
    const bool is_shadow = packet->rays.ray->kind == RAY_SHADOW;
    PacketWalk walk;
    walk.waiting.count = 0;
    walk.searching = packet->active;
    walk.farthest = highest(best->t);
    walk.credit = PACKET_CREDIT;
    walk.best = best;
    expand_node(&walk, scene, packet, 0);
    uint waiting;
    while (next_child(&walk.waiting, walk.farthest, &waiting)) {
        const uint bits = lanes_to_child(&walk, scene, packet, waiting, tally);
        if (walk.credit < 0)
            return lane_bits(walk.searching);
        if (bits == 0)
            continue;
        const uint child = scene->nodes[waiting / WIDE].child[waiting % WIDE];
        if ((child & WIDE_LEAF) == 0) {
            expand_node(&walk, scene, packet, child);
            continue;
        }
        if (CLRT_STATISTICS)
            tally->triangle_tests += WIDE * popcount(bits);
        if (!test_packet_leaf(scene, child & ~WIDE_LEAF, packet, bits, walk.farthest, best))
            continue;
        note_hits(&walk, is_shadow);
        if (is_shadow && !any_lane(walk.searching))
            return 0;
    }
    return 0;
}

// What a packet's rays must share: the signs of their directions and the longest axis.
static inline Count ray_classes(Real3 direction)
{
    const ShearAxes axes = shear_axes(direction);
    const Count x = as_count(direction.x) >> 31, y = as_count(direction.y) >> 31;
    const Count z = as_count(direction.z) >> 31;
    return axes.z * 8 + x * 4 + y * 2 + z;
}

static inline Real one_lane(Real v, uint lane)
{
    return (Real)(real_of(&v, lane));
}

static inline Real3 filled(Real3 v, Truth lanes, uint lane)
{
    return real3_of(lanes ? v.x : one_lane(v.x, lane), lanes ? v.y : one_lane(v.y, lane),
                    lanes ? v.z : one_lane(v.z, lane));
}

// Gathers the lanes whose bits are set, which share signs and the longest axis, into a packet.
static inline void packet_gather(Packet *packet, const Ray *ray, uint bits, uint longest_axis)
{
    const uint first = lowest_bit(bits);
    packet->active = lanes_of(bits);
    packet->common_origin = ray->kind != RAY_REFLECTED;
    packet->rays.ray = ray;
    const Real3 direction = filled(ray->direction, packet->active, first);
    const Real3 origin =
        packet->common_origin ? ray->origin : filled(ray->origin, packet->active, first);
    packet_prepare(packet, origin, direction, longest_axis);
}

// Returns the lanes left over, whose rays have to search alone.
static NOT_INLINE uint meet_together(const SceneView *scene, const FrameData *frame,
                                     const Packet *packet, Hit *best, Tally *tally)
{
    const Truth lanes = packet->active;
    Hit hit = *best;
    uint left = 0;
    if (CLRT_BVH && frame->uses_bvh) {
        left = traverse_packet(scene, packet, &hit, tally);
    } else {
        for (uint block = 0; block * WIDE < frame->triangle_count; block++)
            test_packet_block(scene, block, packet, lanes, INFINITY, &hit);
        if (CLRT_STATISTICS)
            tally->triangle_tests += frame->triangle_count * lane_count(lanes);
    }
    best->t = lanes ? hit.t : best->t;
    best->id = lanes ? hit.id : best->id;
    best->index = lanes ? hit.index : best->index;
    return left;
}

// Rays that share signs and longest axis with enough others go as a packet, the rest alone.
// Without a tree there is nothing to walk, and all go as packets.
static void meet_triangles(const SceneView *scene, const FrameData *frame, const Ray *ray,
                           Hit *best, Tally *tally)
{
    const uint all = lane_bits(ray->active);
    const bool has_tree = CLRT_BVH && frame->uses_bvh;
    const uint smallest = has_tree ? SMALLEST_PACKET : 1;
    uint alone = has_tree && !CLRT_PACKET ? all : 0;
    uint left = all & ~alone;
    const Count classes = ray_classes(ray->direction);
    while (left != 0) {
        const uint wanted = count_of(&classes, lowest_bit(left));
        const uint part = left & lane_bits(classes == wanted);
        left &= ~part;
        if (popcount(part) < smallest) {
            alone |= part;
            continue;
        }
        Packet packet;
        packet_gather(&packet, ray, part, wanted / 8);
        alone |= meet_together(scene, frame, &packet, best, tally);
    }
    if (alone == 0)
        return;
    Search search;
    search.ray = ray;
    search.axes = shear_axes(ray->direction);
    search.shear = shear_along(ray->direction, &search.axes);
    search_slabs(&search, ray->origin, ray->direction);
    meet_alone(scene, &search, alone, best, tally);
}

#endif
#endif
