// SPDX-License-Identifier: MIT
// Callers pass rays and read hits in fp64 and in scene coordinates. The device receives rays and
// returns hits in float and in normalized coordinates. A ray's direction is scaled by a power of
// two so that its largest component is in [1, 2). The device's t then stays in the range of floats.
// An origin is far if the magnitude of a coordinate exceeds the side of a cube around the scene.
// Rounding such an origin to float would move the ray too far, so the origin first advances to the
// cube.
//
// The threads of a pool share the conversions, because a single thread would limit a device with
// many cores to about 50 million rays per second.
//
// Invariant: each conversion depends only on the ray and the scene, so a ray has the same hit in
// every batch.
#include "library/ray_batch.h"

#include "base/thread_pool.h"

#include <math.h>
#include <string.h>

// The number of consecutive entries that a thread converts.
#define RANGE_ENTRIES 1024

// With the compiler's own choices, storing all results made calls up to 19 % slower.
#define INLINED static inline __attribute__((always_inline))

// The smallest value of RayBatch::cube. All triangles are within [-1, 1] on each axis.
#define LEAST_CUBE 2.0

// The largest normalized distance of a ray's start from the plane of the triangle in `starts`.
#define OFF_PLANE 0x1p-15

// Rays that start beyond this distance from the normalized origin hit nothing (intersect.cl). Only
// rays that miss the cube around the scene start there, because the limits of spheres (normalize.h)
// keep every cube within this distance.
#define FARTHEST 0x1p45

static Vec3 given_vector(const double *vectors, size_t stride, size_t index)
{
    const size_t bytes = index * (stride != 0 ? stride : 3 * sizeof(double));
    return vec3_of_doubles((const double *)(const void *)((const char *)vectors + bytes));
}

GivenRay given_ray(const ClrtRays *rays, size_t index)
{
    return (GivenRay){given_vector(rays->origins, rays->origin_stride, index),
                      rays->directions != NULL
                          ? given_vector(rays->directions, rays->direction_stride, index)
                          : vec3(0, 0, 1),
                      rays->nears != NULL ? rays->nears[index] : 0,
                      rays->fars != NULL ? rays->fars[index] : INFINITY,
                      rays->starts != NULL ? rays->starts[index] : CLRT_NOTHING};
}

typedef struct {
    Vec3 at[3], normal;
} Face;

static inline Face face_of(const RayScene *scene, uint32_t id)
{
    const Triangles *triangles = &scene->form.stages.triangles;
    const size_t triangle = id - scene->form.flat.sphere_count;
    const Vec3 a = vec3_of_floats(triangles_corner(triangles, triangle, 0));
    const Vec3 b = vec3_of_floats(triangles_corner(triangles, triangle, 1));
    const Vec3 c = vec3_of_floats(triangles_corner(triangles, triangle, 2));
    return (Face){{a, b, c}, vec3_normalize(vec3_cross(vec3_sub(b, a), vec3_sub(c, a)))};
}

static double entry_of_axis(double cube, double origin, double direction)
{
    return direction == 0 ? -INFINITY : (-copysign(cube, direction) - origin) / direction;
}

// Returns the t at which the ray's line enters the cube. If the line misses the cube, the result is
// meaningless.
static double cube_entry(double cube, Vec3 origin, Vec3 direction)
{
    return fmax(fmax(entry_of_axis(cube, origin.x, direction.x),
                     entry_of_axis(cube, origin.y, direction.y)),
                entry_of_axis(cube, origin.z, direction.z));
}

// Returns half the side of a cube around the origin. The cube is about twice as large as the scene.
static double cube_around(const FlatScene *flat)
{
    double cube = LEAST_CUBE;
    for (int axis = 0; axis < 3 && flat->sphere_count > 0; axis++)
        cube = fmax(cube, 2 * fmax(fabs((double)flat->bounds.low[axis]),
                                   fabs((double)flat->bounds.high[axis])));
    return cube;
}

// Returns the sum of the components' magnitudes, which is NaN if a component is NaN.
static double sum_of(Vec3 v)
{
    return fabs(v.x) + fabs(v.y) + fabs(v.z);
}

// Returns the power of two that scales a size from [1e-300, 1e300] into [1, 2). The bit operations
// replace ilogb and scalbn. With fmax, these functions took 15 % of a batch's processor time.
static double power_to_one(double size)
{
    uint64_t bits;
    double power;
    memcpy(&bits, &size, sizeof bits);
    bits = (UINT64_C(2046) << 52) - (bits & UINT64_C(0x7ff) << 52);
    memcpy(&power, &bits, sizeof power);
    return power;
}

static Vec3 point_at(Vec3 origin, Vec3 direction, double t)
{
    return vec3_add(origin, vec3_scale(direction, t));
}

// Stores a ray's direction, limit and scale. Returns the ray's start in normalized coordinates. The
// start is the point at `near` or, if this point is far, a point further along the ray at the cube
// around the scene. A ray that can hit nothing gets a limit below 0. A ray whose numbers are not
// usable also gets an infinite doubt.
static Vec3 convert_line(RayBatch *batch, size_t entry, const GivenRay *given)
{
    const Normalization *frame = &batch->scene->frame;
    const double largest = vec3_extent(given->direction);
    const bool is_usable = largest >= 1e-300 && sum_of(given->direction) <= 1e300;
    const double shrink = is_usable ? power_to_one(largest) : 0, unit = shrink * batch->unit;
    const Vec3 direction = vec3_scale(given->direction, shrink);
    // Calling normalize_point would make calls for camera rays 4 % slower.
    const Vec3 origin = vec3_scale(vec3_sub(given->origin, frame->center), frame->scale);
    double start = given->near != 0 ? given->near / unit : 0;
    Vec3 from = start != 0 ? point_at(origin, direction, start) : origin;
    if (vec3_extent(from) > 2 * batch->cube) {
        start = fmax(start, cube_entry(batch->cube, origin, direction));
        from = point_at(origin, direction, start);
    }
    const double limit = given->far != INFINITY ? given->far / unit - start : INFINITY;
    const bool is_ray = is_usable && given->near > -INFINITY && sum_of(from) < FARTHEST;
    RayData *ray = &batch->data[entry];
    ray->doubt = is_ray ? 0 : INFINITY;
    ray->limit = !is_ray || !(limit >= 0) ? -1 : limit < 0x1p127 ? (float)limit : INFINITY;
    vec3_store(ray->direction, direction);
    batch->scales[entry] = (RayScale){start, unit};
    return from;
}

// Returns a bound on the distance of a ray's stored origin from its exact start. `off` is the
// distance by which the start was moved. Errors of fp64 arithmetic are at most 2^-52 of the
// coordinates of the given origin and of the start. Rounding to float adds 2^-24 of the start.
static float doubt_of(const RayBatch *batch, const GivenRay *given, Vec3 start, double off)
{
    const double size = sum_of(start);
    const double whole = size + sum_of(normalize_point(&batch->scene->frame, given->origin));
    return (float)(0x1p-50 * whole + 1.01 * off + 1.01 * 0x1p-24 * size);
}

static uint64_t primitive_count(const RayScene *scene)
{
    return (uint64_t)scene->form.flat.sphere_count + scene->form.flat.triangle_count;
}

// Moves a ray's start onto the plane of a triangle. Returns the distance of the move.
static double move_to_plane(const RayBatch *batch, uint32_t id, Vec3 *start)
{
    const Face face = face_of(batch->scene, id);
    const double off = vec3_dot(face.normal, vec3_sub(*start, face.at[0]));
    *start = vec3_sub(*start, vec3_scale(face.normal, off));
    return fabs(off);
}

// Converts a ray. If near is not 0, the ray only skips the primitive in `starts`. If this primitive
// does not exist, the ray's element of `offs` is INFINITY.
static void convert(RayBatch *batch, size_t entry)
{
    RayData *ray = &batch->data[entry];
    const RayScene *scene = batch->scene;
    const uint32_t spheres = scene->form.flat.sphere_count;
    const GivenRay given = given_ray(&batch->rays, batch->first + batch->order[entry]);
    Vec3 start = convert_line(batch, entry, &given);
    double off = 0;
    ray->own = given.own;
    ray->own_index = NOTHING;
    if (given.own != NOTHING && given.own >= primitive_count(scene))
        off = INFINITY;
    else if (given.own != NOTHING && given.near == 0)
        ray->own_index = given.own < spheres ? given.own : scene->places[given.own - spheres].index;
    if (ray->own_index != NOTHING && given.own >= spheres && ray->limit >= 0)
        off = move_to_plane(batch, given.own, &start);
    vec3_store(ray->origin, start);
    // Without doubts, which no other query needs, calls for camera rays take 1 to 3 % less time.
    if (batch->cast.query == RAYS_CERTAIN)
        ray->doubt += doubt_of(batch, &given, start, off);
    if (batch->rays.starts != NULL)
        batch->offs[entry] = off;
}

static void convert_range(void *context, uint32_t first, uint32_t end)
{
    for (uint32_t entry = first; entry < end; entry++)
        convert(context, entry);
}

static bool check_start(const RayBatch *batch, size_t entry, ClrtError *error)
{
    const double off = batch->offs[entry];
    const size_t number = batch->first + batch->order[entry];
    const uint32_t own = batch->data[entry].own;
    if (off == INFINITY)
        return check_fail(error, CLRT_ARGUMENT, "ray %zu starts on primitive %u of %llu", number,
                          own, (unsigned long long)primitive_count(batch->scene));
    return !(off > OFF_PLANE) ||
           check_fail(error, CLRT_ARGUMENT,
                      "ray %zu should start on primitive %u, but starts %.3g from its plane; at "
                      "most %.3g are allowed",
                      number, own, off * batch->unit, OFF_PLANE * batch->unit);
}

bool ray_batch_convert(RayBatch *batch, ClrtError *error)
{
    bool ok = true;
    batch->unit = 1 / batch->scene->frame.scale;
    batch->cube = cube_around(&batch->scene->form.flat);
    thread_pool_share(batch->pool, batch->cast.count, RANGE_ENTRIES, convert_range, batch);
    for (size_t entry = 0; ok && batch->rays.starts != NULL && entry < batch->cast.count; entry++)
        ok = check_start(batch, entry, error);
    return ok;
}

// Stores the barycentric weights of the second and third corner at the point where the ray's line
// crosses the triangle's plane (Moeller and Trumbore, JGT 2(1) 1997). Rounding can put the point
// outside the triangle, so the weights are clamped.
INLINED void weights_at(double weights[2], const Face *face, Vec3 origin, Vec3 direction)
{
    const Vec3 ab = vec3_sub(face->at[1], face->at[0]), ac = vec3_sub(face->at[2], face->at[0]);
    const Vec3 from = vec3_sub(origin, face->at[0]), across = vec3_cross(direction, ac);
    const double determinant = vec3_dot(ab, across);
    if (determinant == 0)
        return;
    const double second = vec3_dot(from, across) / determinant;
    const double third = vec3_dot(direction, vec3_cross(from, ab)) / determinant;
    weights[0] = fmin(fmax(second, 0), 1);
    weights[1] = fmin(fmax(third, 0), 1 - weights[0]);
}

static Vec3 sphere_normal(const SphereData *sphere, Vec3 point)
{
    const Vec3 center =
        vec3_add(vec3_of_floats(sphere->center), vec3_of_floats(sphere->center_low));
    return vec3_normalize(vec3_sub(point, center));
}

// Stores the results that need the surface. `to` is the hit's place in the caller's arrays.
INLINED void store_surface(const RayBatch *batch, const ClrtHits *hits, size_t entry, HitData hit,
                           size_t to)
{
    const RayData *ray = &batch->data[entry];
    const FlatScene *flat = &batch->scene->form.flat;
    const Vec3 origin = vec3_of_floats(ray->origin), direction = vec3_of_floats(ray->direction);
    double weights[2] = {0, 0};
    Vec3 normal = {0, 0, 0};
    if (hit.id != NOTHING && hit.id < flat->sphere_count) {
        normal = sphere_normal(&flat->spheres[hit.id], point_at(origin, direction, (double)hit.t));
    } else if (hit.id != NOTHING) {
        const Face face = face_of(batch->scene, hit.id);
        weights_at(weights, &face, origin, direction);
        normal = face.normal;
    }
    if (hits->weights != NULL)
        memcpy(hits->weights + 2 * to, weights, sizeof weights);
    if (hits->normals != NULL)
        vec3_store_doubles(hits->normals + 3 * to, normal);
    if (hits->fronts != NULL)
        hits->fronts[to] = hit.id != NOTHING && vec3_dot(normal, direction) <= 0;
}

INLINED void store_place(const RayBatch *batch, const ClrtHits *hits, HitData hit, size_t to)
{
    static const TrianglePlace nowhere = {NOTHING, NOTHING, NOTHING};
    const uint32_t spheres = batch->scene->form.flat.sphere_count;
    const TrianglePlace *place =
        hit.id != NOTHING && hit.id >= spheres ? &batch->scene->places[hit.id - spheres] : &nowhere;
    if (hits->meshes != NULL)
        hits->meshes[to] = place->mesh;
    if (hits->triangles != NULL)
        hits->triangles[to] = place->number;
}

// Stores the results for which the caller has arrays in `hits`, and the flags unless they are NULL.
// Without the early return, loops that store nothing would take 7 % of a call for camera rays.
INLINED void store(const RayBatch *batch, ClrtHits hits, uint8_t *flags, uint32_t first,
                   uint32_t end)
{
    const bool is_nearest = batch->cast.query == RAYS_NEAREST;
    const size_t room = batch->results.hits.room;
    const bool has_surface = hits.weights != NULL || hits.normals != NULL || hits.fronts != NULL;
    const bool has_place = hits.meshes != NULL || hits.triangles != NULL;
    if (flags == NULL && hits.counts == NULL && hits.distances == NULL && hits.primitives == NULL &&
        !has_place && !has_surface)
        return;
    for (size_t entry = first; entry < end; entry++) {
        const size_t ray = batch->first + batch->order[entry];
        const HitData *found = batch->found + entry * room;
        if (flags != NULL)
            flags[ray] = is_nearest ? found->id != NOTHING : (batch->counts[entry] & 1) != 0;
        if (hits.counts != NULL)
            hits.counts[ray] = batch->counts[entry];
        for (size_t i = 0; i < room; i++) {
            const RayScale *scale = &batch->scales[entry];
            const HitData hit = found[i];
            const size_t to = ray * room + i;
            if (hits.distances != NULL)
                hits.distances[to] =
                    hit.id == NOTHING ? INFINITY : (scale->start + (double)hit.t) * scale->unit;
            if (hits.primitives != NULL)
                hits.primitives[to] = hit.id;
            if (has_place)
                store_place(batch, &hits, hit, to);
            if (has_surface)
                store_surface(batch, &hits, entry, hit, to);
        }
    }
}

// Separate loops take half as long as a single loop that fills all arrays.
static void store_range(void *context, uint32_t first, uint32_t end)
{
    const RayBatch *batch = context;
    const ClrtHits *hits = &batch->results.hits;
    const bool is_certain = batch->cast.query == RAYS_CERTAIN;
    store(batch, (ClrtHits){.counts = hits->counts},
          is_certain ? hits->certain : batch->results.flags, first, end);
    if (is_certain)
        return;
    store(batch, (ClrtHits){.distances = hits->distances}, NULL, first, end);
    store(batch, (ClrtHits){.primitives = hits->primitives}, NULL, first, end);
    store(batch, (ClrtHits){.meshes = hits->meshes, .triangles = hits->triangles}, NULL, first,
          end);
    store(batch,
          (ClrtHits){.weights = hits->weights, .normals = hits->normals, .fronts = hits->fronts},
          NULL, first, end);
}

void ray_batch_store(RayBatch *batch)
{
    thread_pool_share(batch->pool, batch->cast.count, RANGE_ENTRIES, store_range, batch);
}
