// SPDX-License-Identifier: MIT
// Kernels that trace arrays of rays with the real functions; built behind the real kernels, where
// everything they call is declared.  A work-item takes CLRT_LANES rays that follow each other.
// Every grid is as large as ray_batch.c says.

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

// The rays of a work-item, one in each lane; `first` is the place of the first.
typedef struct {
    Real3 origin, direction;
    UInt own, kind;
    uint first;
    Mask exist; // lanes whose ray is among the count
} TestRays;

// Lanes past the end read the last ray.
static inline TestRays test_rays(global const TestRay *rays, uint count)
{
    const uint first = CLRT_LANES * (uint)get_global_id(0);
    const UInt place = first + LANE_Y * PACKET_WIDTH + LANE_X;
    const UInt last = count - 1;
    const Record record = record_at(rays, min(place, last) * WORDS(TestRay));
    return (TestRays){record_real3(&record, 0, 1),
                      record_real3(&record, 4, 1),
                      record_word(&record, 3),
                      record_word(&record, 7),
                      first,
                      place < count};
}

static inline Mask same_in_first(UInt value, Mask among)
{
    return value == first_lane(value, among);
}

// Those lanes of `left` that may search with the first of them: their rays are of one kind and,
// as the camera's do, start at one point.
static inline Mask companions(const TestRays *rays, Mask left)
{
    const Real3 o = rays->origin;
    const Mask same_kind = left && same_in_first(rays->kind, left);
    const Mask same_origin = as_bits(o.x) == as_bits(first_real(o.x, left)) &&
                             as_bits(o.y) == as_bits(first_real(o.y, left)) &&
                             as_bits(o.z) == as_bits(first_real(o.z, left));
    return same_kind && (rays->kind != (uint)RAY_CAMERA || same_origin);
}

static inline Real filled_lane(Real value, Mask lanes)
{
    return lanes ? value : first_real(value, lanes);
}

static inline Real3 filled_lanes(Real3 v, Mask lanes)
{
    return real3_of(filled_lane(v.x, lanes), filled_lane(v.y, lanes), filled_lane(v.z, lanes));
}

static inline uint first_kind(const TestRays *rays, Mask lanes)
{
    const UInt kind = first_lane(rays->kind, lanes);
    return *(const uint *)&kind;
}

// Reflected rays are made by the tracer's own function, from a face they look straight away from;
// a shadow ray ends where t is 1.  The other lanes copy the first.
static inline Ray ray_of(const Tracer *tracer, const TestRays *rays, Mask lanes)
{
    const Real3 origin = filled_lanes(rays->origin, lanes);
    const Real3 direction = filled_lanes(rays->direction, lanes);
    const uint kind = first_kind(rays, lanes);
    Surface surface;
    surface.id = rays->own;
    surface.index = NOTHING;
    surface.room = 0.0f;
    surface.edge = 0.0f;
    surface.point = origin;
    surface.normal = real3_of(0.0f, 0.0f, 0.0f);
    surface.face = direction;
    surface.toward_viewer = negative3(direction);
    if (kind == RAY_REFLECTED)
        return ray_reflected(tracer, &surface, lanes);
    return (Ray){origin, direction, rays->own, NOTHING, (RayKind)kind, lanes};
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

// Finds the rays' hits or, for shadow rays, whether they are blocked, as 1 in place of the id.
static inline void trace_rays(const Tracer *tracer, const TestRays *rays, bool are_shadows,
                              global TestHit *hits)
{
    Mask left = rays->exist;
    while (any_lane(left)) {
        const Mask lanes = companions(rays, left);
        const Ray ray = ray_of(tracer, rays, lanes);
        Hit hit = {0.0f, NOTHING, NOTHING};
        if (are_shadows)
            hit.id = is_blocked(tracer, &ray) ? (UInt)(1) : (UInt)(0);
        else
            hit = nearest_hit(tracer, &ray);
        store_hits(hits, rays, lanes, hit.t, hit.id);
        left = left && !lanes;
    }
}

kernel void batch_nearest(const FrameData frame, global const SphereData *spheres,
                          global const Node *nodes, global const Triangles *triangles,
                          global const TestRay *rays, uint count, global TestHit *hits)
{
    if (count == 0)
        return;
    Tally tally = {0};
    const Tracer tracer = {0, 0, spheres, nodes, triangles, 0, 0, &frame, &tally};
    const TestRays all = test_rays(rays, count);
    trace_rays(&tracer, &all, false, hits);
}

// id becomes 1 where the ray, a shadow ray, is blocked.
kernel void batch_blocked(const FrameData frame, global const SphereData *spheres,
                          global const Node *nodes, global const Triangles *triangles,
                          global const TestRay *rays, uint count, global TestHit *hits)
{
    if (count == 0)
        return;
    Tally tally = {0};
    const Tracer tracer = {0, 0, spheres, nodes, triangles, 0, 0, &frame, &tally};
    const TestRays all = test_rays(rays, count);
    trace_rays(&tracer, &all, true, hits);
}

// Finds the hit of a ray that leaves the surface hit by its own ray, in the direction of outward or
// the opposite one, whichever leaves the face. The id is LEAVE_SHADOWED if the ray hits nothing but
// the point at its end does not light the surface. t is 0 without a surface.
#define LEAVE_SHADOWED 0xfffffffeu

kernel void batch_leave(const FrameData frame, global const SphereData *spheres,
                        global const Node *nodes, global const Triangles *triangles,
                        global const TestRay *rays, uint count, global TestHit *hits,
                        global const TriangleLook *looks, global const CornerNormals *normals,
                        global const float *outward)
{
    if (count == 0)
        return;
    Tally tally = {0};
    const Tracer tracer = {0, 0, spheres, nodes, triangles, looks, normals, &frame, &tally};
    const TestRays all = test_rays(rays, count);
    const UInt place = all.first + LANE_Y * PACKET_WIDTH + LANE_X, last = count - 1;
    const Record record = record_at(outward, min(place, last) * 3);
    const Real3 chosen = record_real3(&record, 0, 1);
    Mask left = all.exist;
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
// The first lane's ray, as the searches want it, in every lane of which only that one counts.
static inline void prepare_first(Packet *packet, const Tracer *tracer, const Ray *ray)
{
    const UInt classes = ray_classes(ray->direction);
    packet_gather(packet, tracer, ray, 1, lane_uint(&classes, 0) / 8);
}

// Where the ray alone meets a triangle, by the test of packets or by that of blocks.
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

// Tests the first ray against each triangle of count blocks alone, in file order.
kernel void batch_each(const FrameData frame, global const SphereData *spheres,
                       global const Node *nodes, global const Triangles *triangles,
                       global const TestRay *rays, uint count, global TestHit *hits)
{
    const uint block = get_global_id(0);
    if (block >= count)
        return;
    Tally tally = {0};
    const Tracer tracer = {0, 0, spheres, nodes, triangles, 0, 0, &frame, &tally};
    TestRays all = test_rays(rays, 1);
    const Ray ray = ray_of(&tracer, &all, lanes_of(1));
    Packet packet;
    prepare_first(&packet, &tracer, &ray);
    for (uint place = 0; place < WIDE; place++) {
        const uint id = triangles[block].id[place] & ~TRIANGLE_MARKS;
        if (triangles[block].id[place] != NOTHING)
            hits[id - frame.sphere_count] =
                (TestHit){distance_alone(triangles, block, place, &packet), id};
    }
}

// Which of the first two children's boxes the lanes' rays meet, each those of its own node.
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

// Which boxes of its own node each ray meets: bit 0 of id the first, bit 1 the second.  Rays that
// may go as a packet do, though their origins differ, as reflected ones do.
kernel void batch_boxes(const FrameData frame, global const SphereData *spheres,
                        global const Node *nodes, global const Triangles *triangles,
                        global const TestRay *rays, uint count, global TestHit *hits)
{
    if (count == 0)
        return;
    Tally tally = {0};
    const Tracer tracer = {0, 0, spheres, nodes, triangles, 0, 0, &frame, &tally};
    TestRays all = test_rays(rays, count);
    all.kind = (UInt)((uint)RAY_REFLECTED);
    const UInt classes = ray_classes(all.direction);
    Mask left = all.exist;
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
// Tests the first ray against each of count triangles alone, in file order.
kernel void batch_each(const FrameData frame, global const SphereData *spheres,
                       global const Node *nodes, global const Triangles *triangles,
                       global const TestRay *rays, uint count, global TestHit *hits)
{
    const uint place = get_global_id(0);
    if (place >= count)
        return;
    Tally tally = {0};
    const Tracer tracer = {0, 0, spheres, nodes, triangles, 0, 0, &frame, &tally};
    const TestRays all = test_rays(rays, 1);
    const Ray ray = ray_of(&tracer, &all, 1);
    const Search search = search_along(&tracer, &ray);
    const Real t = triangle_distance(&triangles[place], &search);
    hits[triangles[place].id - frame.sphere_count] = (TestHit){t, triangles[place].id};
}

// Which boxes of its own node each ray meets: bit 0 of id the first, bit 1 the second.
kernel void batch_boxes(const FrameData frame, global const SphereData *spheres,
                        global const Node *nodes, global const Triangles *triangles,
                        global const TestRay *rays, uint count, global TestHit *hits)
{
    const uint place = get_global_id(0);
    if (place >= count)
        return;
    Tally tally = {0};
    const Tracer tracer = {0, 0, spheres, nodes, triangles, 0, 0, &frame, &tally};
    const TestRays all = test_rays(rays, count);
    const Ray ray = ray_of(&tracer, &all, 1);
    const Search search = search_along(&tracer, &ray);
    Real2 entry, leave;
    intersect_slabs(&nodes[place], &search, INFINITY, &entry, &leave);
    hits[place] = (TestHit){0.0f, (entry.x <= leave.x ? 1u : 0u) | (entry.y <= leave.y ? 2u : 0u)};
}
#endif
