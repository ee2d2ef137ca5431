// SPDX-License-Identifier: MIT
// Kernels that trace arrays of rays with the real functions. ray_batch.c appends this file to the
// source of the real kernels. A work-item traces CLRT_LANES successive rays. Grids are larger than
// the count of rays.

typedef struct {
    float origin[3];
    uint own;
    float direction[3];
    uint kind;
} TestRay;

typedef struct {
    float t;
    uint id;
} TestHit;

// The rays of a work-item, one per lane.
typedef struct {
    Real3 origin, direction;
    UInt own, kind;
    uint first;  // index of the first lane's ray
    UInt index;  // of the lane's ray
    Mask exists; // lanes that have a ray; the others copy the last ray
} TestRays;

static inline TestRays test_rays(global const TestRay *rays, uint count)
{
    TestRays all;
    const UInt last = count - 1;
    all.first = CLRT_LANES * (uint)get_global_id(0);
    const UInt place = all.first + LANE_Y * PACKET_WIDTH + LANE_X;
    all.exists = place < count;
    all.index = min(place, last);
    const Record record = record_at(rays, all.index * WORDS(TestRay));
    all.origin = record_real3(&record, 0, 1);
    all.own = record_word(&record, 3);
    all.direction = record_real3(&record, 4, 1);
    all.kind = record_word(&record, 7);
    return all;
}

static inline Mask same_in_first(UInt value, Mask among)
{
    return value == first_lane(value, among);
}

// Returns the lanes of `left` that form a packet with the first of them: their rays have the same
// kind, and camera rays the same origin.
static inline Mask companions(const TestRays *rays, Mask left)
{
    const Real3 o = rays->origin;
    const Mask same_kind = left && same_in_first(rays->kind, left);
    const Mask same_origin = as_bits(o.x) == as_bits(first_real(o.x, left)) &&
                             as_bits(o.y) == as_bits(first_real(o.y, left)) &&
                             as_bits(o.z) == as_bits(first_real(o.z, left));
    return same_kind && (rays->kind != (uint)RAY_CAMERA || same_origin);
}

// Returns v with the first of these lanes copied to all others.
static inline Real3 filled_lanes(Real3 v, Mask lanes)
{
    return real3_of(lanes ? v.x : first_real(v.x, lanes), lanes ? v.y : first_real(v.y, lanes),
                    lanes ? v.z : first_real(v.z, lanes));
}

// Returns the rays of these lanes. The other lanes copy the first. Reflected rays come from the
// tracer's own function, and leave their face perpendicularly.
static inline Ray ray_of(const Tracer *tracer, const TestRays *rays, Mask lanes)
{
    const Real3 origin = filled_lanes(rays->origin, lanes);
    const Real3 direction = filled_lanes(rays->direction, lanes);
    const UInt kinds = first_lane(rays->kind, lanes);
    const RayKind kind = (RayKind)(*(const uint *)&kinds);
    const Surface surface = {.point = origin,
                             .face = direction,
                             .toward_viewer = negative3(direction),
                             .id = rays->own,
                             .index = NOTHING};
    if (kind == RAY_REFLECTED)
        return ray_reflected(tracer, &surface, lanes);
    return (Ray){origin, direction, rays->own, NOTHING, kind, lanes};
}

static inline void store_hits(global TestHit *hits, const TestRays *rays, Mask lanes, Real t,
                              UInt id)
{
    const uint bits = lane_bits(lanes);
    for (uint lane = 0; lane < CLRT_LANES; lane++)
        if (bits >> lane & 1)
            hits[rays->first + lane] =
                (TestHit){(float)((const Scalar *)&t)[lane], ((const uint *)&id)[lane]};
}

// Stores the rays' hits or, for shadow rays, the id 1 if they are blocked and else 0.
static inline void trace_rays(const Tracer *tracer, TestRays rays, bool are_shadows,
                              global TestHit *hits)
{
    Mask left = rays.exists;
    while (any_lane(left)) {
        const Mask lanes = companions(&rays, left);
        const Ray ray = ray_of(tracer, &rays, lanes);
        Hit hit = {0.0f, NOTHING, NOTHING};
        if (are_shadows)
            hit.id = is_blocked(tracer, &ray) ? (UInt)(1) : (UInt)(0);
        else
            hit = nearest_hit(tracer, &ray);
        store_hits(hits, &rays, lanes, hit.t, hit.id);
        left = left && !lanes;
    }
}

// The arguments and the first statements of every kernel. A launch without rays does nothing.
#define BATCH_ARGUMENTS                                                                            \
    TRACER_ARGUMENTS, global const TestRay *rays, uint count, global const float *outward,         \
        global TestHit *hits
#define BATCH_TRACER                                                                               \
    if (count == 0)                                                                                \
        return;                                                                                    \
    Tally tally = {0};                                                                             \
    const Tracer tracer = TRACER(&tally);

kernel void batch_nearest(BATCH_ARGUMENTS)
{
    BATCH_TRACER
    trace_rays(&tracer, test_rays(rays, count), false, hits);
}

kernel void batch_blocked(BATCH_ARGUMENTS)
{
    BATCH_TRACER
    trace_rays(&tracer, test_rays(rays, count), true, hits);
}

// Finds the hit of a ray that leaves the surface hit by its own ray, in the direction of outward or
// the opposite one, whichever leaves the face. The id is LEAVE_SHADOWED if the ray hits nothing but
// the point at its end does not light the surface. t is 0 without a surface.
#define LEAVE_SHADOWED 0xfffffffeu

kernel void batch_leave(BATCH_ARGUMENTS)
{
    BATCH_TRACER
    const TestRays all = test_rays(rays, count);
    const Record record = record_at(outward, all.index * 3);
    const Real3 chosen = record_real3(&record, 0, 1);
    Mask left = all.exists;
    while (any_lane(left)) {
        const Mask lanes = companions(&all, left);
        const Ray ray = ray_of(&tracer, &all, lanes);
        const Hit first = nearest_hit(&tracer, &ray);
        const Mask met = lanes && first.id != NOTHING;
        Hit second = {0.0f, NOTHING, NOTHING};
        if (any_lane(met)) {
            const Surface surface = surface_at(&tracer, &ray, &first, met);
            const Mask inward = dot_product(chosen, surface.face) < 0.0f;
            const Real3 direction = choose3(inward, negative3(chosen), chosen);
            const Ray next = {surface.point, direction,     surface.id,
                              surface.index, RAY_REFLECTED, met};
            second = nearest_hit(&tracer, &next);
            const LightSample light = {
                .position = sum3(surface.point, direction), .toward = direction, .faces = met};
            const Ray shadow = ray_to_light(&tracer, &surface, &light);
            const Mask dark = is_blocked(&tracer, &shadow);
            second.id = second.id == NOTHING && dark ? (UInt)(LEAVE_SHADOWED) : second.id;
        }
        store_hits(hits, &all, lanes, met ? second.t : 0.0f, met ? second.id : (UInt)(NOTHING));
        left = left && !lanes;
    }
}

#if CLRT_WIDE_NODES
// Returns the distance to one triangle, by the test of packets or the test of blocks.
static inline float distance_alone(global const TriangleBlock *triangles, uint block, uint place,
                                   const Packet *packet)
{
    Hit hit = {INFINITY, NOTHING, NOTHING};
    if (CLRT_PACKET) {
        const BlockPlace at = {&triangles[block], place, block * WIDE + place};
        const Corners corners = {corner_from(&at, 0, packet), corner_from(&at, 1, packet),
                                 corner_from(&at, 2, packet)};
        intersect_packet_triangle(&at, packet, &corners, packet->active, &hit);
        return lane_real(&hit.t, 0);
    }
    const LaneRay ray = lane_ray(&packet->rays, 0);
    const WideCorners relative = {block_corner_relative(&triangles[block], 0, &ray),
                                  block_corner_relative(&triangles[block], 1, &ray),
                                  block_corner_relative(&triangles[block], 2, &ray)};
    BlockTest test;
    test.shear = ray.shear;
    test.sheared = corners_sheared(&relative, &ray.shear);
    test.edges = edges_of(&test.sheared);
    test.inside = edges_contain(&test.edges);
    const float8 distances = block_distances(&triangles[block], &packet->rays, 0, &test, INFINITY);
    return ((const float *)&distances)[place];
}

// Intersects the first ray with each triangle of count blocks alone. Hits are in file order.
kernel void batch_each(BATCH_ARGUMENTS)
{
    const uint block = get_global_id(0);
    if (block >= count)
        return;
    BATCH_TRACER
    TestRays all = test_rays(rays, 1);
    const Ray ray = ray_of(&tracer, &all, lanes_of(1));
    const UInt classes = ray_classes(ray.direction);
    Packet packet; // only the first lane is active
    packet_gather(&packet, &tracer, &ray, 1, lane_uint(&classes, 0) / 8);
    for (uint place = 0; place < WIDE; place++) {
        const uint id = triangles[block].id[place] & ~TRIANGLE_MARKS;
        if (triangles[block].id[place] != NOTHING)
            hits[id - frame.sphere_count] =
                (TestHit){distance_alone(triangles, block, place, &packet), id};
    }
}

// Returns which of its own node's first two boxes each lane's ray meets, as bits 0 and 1.
static inline UInt boxes_met(global const Node *nodes, const Packet *packet, uint lanes)
{
    UInt met = 0;
    for (; lanes != 0; lanes &= lanes - 1) {
        const uint lane = lowest_bit(lanes);
        float8 entry;
        uint near = lane_bits(
            CLRT_PACKET ? children_near(&nodes[lane], packet, INFINITY, &entry)
                        : children_hit(&nodes[lane], &packet->rays, lane, INFINITY, &entry));
        for (uint child = 0; child < 2 && CLRT_PACKET; child++)
            if ((lane_bits(lanes_in_child(&nodes[lane], child, packet, INFINITY)) >> lane & 1) == 0)
                near &= ~(1u << child);
        ((uint *)&met)[lane] = near & 3;
    }
    return met;
}

// Stores which boxes of its own node each ray meets: bit 0 of id for the first, bit 1 for the
// second. Like reflected rays, rays with different origins form packets.
kernel void batch_boxes(BATCH_ARGUMENTS)
{
    BATCH_TRACER
    TestRays all = test_rays(rays, count);
    all.kind = (UInt)((uint)RAY_REFLECTED);
    const UInt classes = ray_classes(all.direction);
    Mask left = all.exists;
    while (any_lane(left)) {
        const Mask lanes = left && same_in_first(classes, left);
        const UInt wanted = first_lane(classes, left);
        Ray ray = ray_of(&tracer, &all, lanes);
        ray.direction = filled_lanes(all.direction, lanes);
        Packet packet;
        packet_gather(&packet, &tracer, &ray, lane_bits(lanes), lane_uint(&wanted, 0) / 8);
        store_hits(hits, &all, lanes, 0.0f,
                   boxes_met(nodes + all.first, &packet, lane_bits(lanes)));
        left = left && !lanes;
    }
}
#else
// Intersects the first ray with each of count triangles alone. Hits are in file order.
kernel void batch_each(BATCH_ARGUMENTS)
{
    const uint place = get_global_id(0);
    if (place >= count)
        return;
    BATCH_TRACER
    const TestRays all = test_rays(rays, 1);
    const Ray ray = ray_of(&tracer, &all, 1);
    const Search search = search_along(&tracer, &ray);
    const Real t = triangle_distance(&triangles[place], &search);
    hits[triangles[place].id - frame.sphere_count] = (TestHit){t, triangles[place].id};
}

// The same for single rays.
kernel void batch_boxes(BATCH_ARGUMENTS)
{
    const uint place = get_global_id(0);
    if (place >= count)
        return;
    BATCH_TRACER
    const TestRays all = test_rays(rays, count);
    const Ray ray = ray_of(&tracer, &all, 1);
    const Search search = search_along(&tracer, &ray);
    Real2 entry, leave;
    intersect_slabs(&nodes[place], &search, INFINITY, &entry, &leave);
    hits[place] = (TestHit){0.0f, (entry.x <= leave.x ? 1u : 0u) | (entry.y <= leave.y ? 2u : 0u)};
}
#endif
