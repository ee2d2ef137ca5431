// SPDX-License-Identifier: MIT
// Kernels that trace arrays of rays with the real functions; built behind the real kernels, where
// everything they call is declared.  Every grid has BATCH_GRID items, as ray_batch.c says.

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

// Rays are made by the tracer's own functions, from surfaces that give such rays: a reflected ray
// continues along a face it looks straight away from, and a shadow ray ends where t is 1.
static inline Ray ray_of(global const TestRay *ray)
{
    const float3 origin = load3(ray->origin), direction = load3(ray->direction);
    Surface surface = {.id = ray->own};
    if (ray->kind == RAY_SHADOW) {
        surface.point = origin + direction;
        return ray_from_light(origin, &surface);
    }
    if (ray->kind == RAY_REFLECTED) {
        surface.point = origin;
        surface.face = direction;
        surface.toward_viewer = -direction;
        return ray_reflected(&surface);
    }
    return (Ray){.origin = origin, .direction = direction, .own = ray->own, .kind = RAY_CAMERA};
}

kernel void batch_nearest(const FrameData frame, global const SphereData *spheres,
                          global const BvhPair *nodes, global const TriangleData *triangles,
                          global const TestRay *rays, uint count, global TestHit *hits)
{
    const uint place = get_global_id(0);
    if (place >= count)
        return;
    const SceneView scene = {0, 0, spheres, nodes, triangles, 0};
    const Ray ray = ray_of(&rays[place]);
    Tally tally = {0};
    const Hit hit = nearest_hit(&scene, &frame, &ray, &tally);
    hits[place] = (TestHit){hit.t, hit.id};
}

// id becomes 1 where the ray, a shadow ray, is blocked.
kernel void batch_blocked(const FrameData frame, global const SphereData *spheres,
                          global const BvhPair *nodes, global const TriangleData *triangles,
                          global const TestRay *rays, uint count, global TestHit *hits)
{
    const uint place = get_global_id(0);
    if (place >= count)
        return;
    const SceneView scene = {0, 0, spheres, nodes, triangles, 0};
    const Ray ray = ray_of(&rays[place]);
    Tally tally = {0};
    hits[place] = (TestHit){0.0f, is_blocked(&scene, &frame, &ray, &tally)};
}

// What the first ray makes of each of count triangles alone.
kernel void batch_each(const FrameData frame, global const SphereData *spheres,
                       global const BvhPair *nodes, global const TriangleData *triangles,
                       global const TestRay *rays, uint count, global TestHit *hits)
{
    const uint place = get_global_id(0);
    if (place >= count)
        return;
    const Ray ray = ray_of(&rays[0]);
    const Shear shear = shear_along(&ray);
    const float t = triangle_distance(&triangles[place], &ray, &shear);
    hits[place] = (TestHit){t, triangles[place].id};
}

// Which boxes of its own node each ray meets: bit 0 of id the first, bit 1 the second.
kernel void batch_boxes(const FrameData frame, global const SphereData *spheres,
                        global const BvhPair *nodes, global const TriangleData *triangles,
                        global const TestRay *rays, uint count, global TestHit *hits)
{
    const uint place = get_global_id(0);
    if (place >= count)
        return;
    const Ray ray = ray_of(&rays[place]);
    const Slabs slabs = slabs_of(&ray);
    float2 entry, leave;
    slabs_meet(&nodes[place], &slabs, INFINITY, &entry, &leave);
    hits[place] = (TestHit){0.0f, (entry.x <= leave.x ? 1u : 0u) | (entry.y <= leave.y ? 2u : 0u)};
}
