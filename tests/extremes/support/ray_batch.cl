// SPDX-License-Identifier: MIT
// Kernels that trace arrays of rays with clrt's functions. ray_batch.c appends this file to the
// source of clrt's kernels. A work-item traces PACKETS * CLRT_LANES successive rays. Grids can be
// larger than the count of rays.

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

// The rays of a packet, one per lane.
typedef struct {
    Real3 origin, direction;
    UInt own, kind;
    uint first;  // index of the first lane's ray
    UInt index;  // of the lane's ray
    Mask exists; // lanes that have a ray; the others copy the last ray
} TestRays;

static inline TestRays test_rays(global const TestRay *rays, uint count, uint packet)
{
    TestRays all;
    const UInt last = count - 1;
    all.first = CLRT_LANES * (PACKETS * (uint)get_global_id(0) + packet);
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

// Returns v with copies of the first lane of `lanes` in the lanes outside `lanes`.
static inline Real3 filled_lanes(Real3 v, Mask lanes)
{
    return real3_of(lanes ? v.x : first_real(v.x, lanes), lanes ? v.y : first_real(v.y, lanes),
                    lanes ? v.z : first_real(v.z, lanes));
}

// Returns the rays of these lanes, which must be of one kind. The other lanes copy the first ray.
// Reflected rays come from ray_reflected, as if they left a face perpendicular to them.
static inline Ray ray_of(const Tracer *tracer, const TestRays *rays, RayKind kind, Mask lanes)
{
    const Real3 origin = filled_lanes(rays->origin, lanes);
    const Real3 direction = filled_lanes(rays->direction, lanes);
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

// Finds and stores the hits of the rays of one kind.
static inline void trace_kind(const Tracer *tracer, const TestRays *all, RayKind kind,
                              bool are_shadows, global TestHit *hits)
{
    Ray rays[PACKETS];
    Hit found[PACKETS];
    for (uint i = 0; i < PACKETS; i++)
        rays[i] = ray_of(tracer, &all[i], kind, all[i].exists && all[i].kind == (uint)kind);
    if (are_shadows)
        blocking_hits(tracer, rays, PACKETS, found);
    else
        nearest_hits(tracer, rays, PACKETS, found);
    for (uint i = 0; i < PACKETS; i++)
        if (are_shadows)
            store_hits(hits, &all[i], rays[i].active, 0.0f,
                       found[i].id != NOTHING ? (UInt)(1) : (UInt)(0));
        else
            store_hits(hits, &all[i], rays[i].active, found[i].t, found[i].id);
}

// Stores the rays' hits. For shadow rays, stores the id 1 if they are blocked, else 0.
static inline void trace_rays(const Tracer *tracer, global const TestRay *rays, uint count,
                              bool are_shadows, global TestHit *hits)
{
    TestRays all[PACKETS];
    for (uint i = 0; i < PACKETS; i++)
        all[i] = test_rays(rays, count, i);
    for (uint kind = RAY_CAMERA; kind <= RAY_SHADOW; kind++) {
        bool any = false;
        for (uint i = 0; i < PACKETS; i++)
            any |= any_lane(all[i].exists && all[i].kind == kind);
        if (any)
            trace_kind(tracer, all, (RayKind)kind, are_shadows, hits);
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
    trace_rays(&tracer, rays, count, false, hits);
}

kernel void batch_blocked(BATCH_ARGUMENTS)
{
    BATCH_TRACER
    trace_rays(&tracer, rays, count, true, hits);
}

// The id for a second ray that hits nothing, although a shadow ray from the same point in the same
// direction is blocked.
#define LEAVE_SHADOWED 0xfffffffeu

// Traces rays from the surfaces that these lanes' rays hit. See batch_leave.
static inline void leave_surfaces(const Tracer *tracer, const TestRays *all, const Ray *ray,
                                  Real3 outward, global TestHit *hits)
{
    const Hit first = nearest_hit(tracer, ray);
    const Mask met = ray->active && first.id != NOTHING;
    Hit second = {0.0f, NOTHING, NOTHING};
    if (any_lane(met)) {
        const Surface surface = surface_at(tracer, ray, &first, met);
        const Mask inward = dot_product(outward, surface.face) < 0.0f;
        const Real3 direction = choose3(inward, negative3(outward), outward);
        const Ray next = {surface.point, direction, surface.id, surface.index, RAY_REFLECTED, met};
        second = nearest_hit(tracer, &next);
        const LightSample light = {
            .position = sum3(surface.point, direction), .toward = direction, .faces = met};
        const Ray shadow = ray_to_light(tracer, &surface, &light);
        Hit blocker;
        blocking_hits(tracer, &shadow, 1, &blocker);
        const Mask dark = blocker.id != NOTHING;
        second.id = second.id == NOTHING && dark ? (UInt)(LEAVE_SHADOWED) : second.id;
    }
    store_hits(hits, all, ray->active, met ? second.t : 0.0f, met ? second.id : (UInt)(NOTHING));
}

// Finds the surface that each ray hits, and traces a second ray from this surface. The second ray's
// direction is `outward` or its opposite, whichever points away from the face. Stores the second
// ray's hit. The id can be LEAVE_SHADOWED. t is 0 if the first ray hits nothing.
kernel void batch_leave(BATCH_ARGUMENTS)
{
    BATCH_TRACER
    for (uint i = 0; i < PACKETS; i++) {
        const TestRays all = test_rays(rays, count, i);
        const Record record = record_at(outward, all.index * 3);
        for (uint kind = RAY_CAMERA; kind <= RAY_SHADOW; kind++) {
            const Ray ray = ray_of(&tracer, &all, (RayKind)kind, all.exists && all.kind == kind);
            if (any_lane(ray.active))
                leave_surfaces(&tracer, &all, &ray, record_real3(&record, 0, 1), hits);
        }
    }
}
