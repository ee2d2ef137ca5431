// SPDX-License-Identifier: MIT
// Callers pass rays and read hits in fp64 and in scene coordinates. The device receives rays and
// returns hits in float and in normalized coordinates. A ray's direction is scaled by a power of
// two so that its largest component is in [1, 2). The device's t then stays in float's range. A far
// origin first advances to a cube around the scene, because rounding it to float would move the ray
// too far. An origin is far if a coordinate exceeds the cube's side in magnitude.
//
// The threads of a pool share the conversions, because a single thread would limit a device with
// many cores to about 50 million rays per second.
//
// Invariant: each conversion depends only on the ray and the scene, so a ray has the same hit in
// every batch.
#include "library/ray_parts.h"

#include "base/thread_pool.h"
#include "library/ray_grid.h"

#include <math.h>
#include <stdatomic.h>
#include <string.h>

// The number of entries that a thread converts at once.
#define RANGE_ENTRIES 1024

// The smallest value of RayPart::cube. All triangles are within [-1, 1] on each axis.
#define LEAST_CUBE 2.0

// The largest distance of a ray's start from the plane of its triangle.
#define OFF_PLANE 0x1p-15

// Rays that start beyond this distance from the normalized origin hit nothing (intersect.cl). Only
// rays that miss the scene's cube (RayPart::cube) start there. The limits of spheres (normalize.h)
// keep every such cube within this distance.
#define FARTHEST 0x1p45

typedef struct {
    Vec3 at[3];
} FaceCorners;

static FaceCorners corners_of(const Triangles *triangles, size_t triangle)
{
    return (FaceCorners){{vec3_of_floats(triangles_corner(triangles, triangle, 0)),
                          vec3_of_floats(triangles_corner(triangles, triangle, 1)),
                          vec3_of_floats(triangles_corner(triangles, triangle, 2))}};
}

static Vec3 normal_of(const FaceCorners *corners)
{
    const Vec3 *at = corners->at;
    return vec3_normalize(vec3_cross(vec3_sub(at[1], at[0]), vec3_sub(at[2], at[0])));
}

static double entry_of_axis(double cube, double origin, double direction)
{
    return direction == 0 ? -INFINITY : (-copysign(cube, direction) - origin) / direction;
}

// Returns the t at which the ray's line enters the cube, if the line hits it. The t is below 0 if
// the ray starts inside the cube or moves away from it.
static double cube_entry(double cube, Vec3 origin, Vec3 direction)
{
    return fmax(fmax(entry_of_axis(cube, origin.x, direction.x),
                     entry_of_axis(cube, origin.y, direction.y)),
                entry_of_axis(cube, origin.z, direction.z));
}

// Returns a NaN if a component is a NaN.
static double sum_of(Vec3 v)
{
    return fabs(v.x) + fabs(v.y) + fabs(v.z);
}

// Returns the power of two that scales a size from [1e-300, 1e300] into [1, 2). The bit operations
// replace ilogb and scalbn. These two functions and fmax took 15 % of a call's processor time.
static double power_to_one(double size)
{
    uint64_t bits;
    double power;
    memcpy(&bits, &size, sizeof bits);
    bits = (UINT64_C(2046) << 52) - (bits & UINT64_C(0x7ff) << 52);
    memcpy(&power, &bits, sizeof power);
    return power;
}

// Moves a point along the ray. Adds the sizes of the step and of the new point to *sizes, which
// bounds the rounding errors.
static void advance(Vec3 *origin, Vec3 direction, double t, double *sizes)
{
    const Vec3 way = vec3_scale(direction, t);
    *origin = vec3_add(*origin, way);
    *sizes += sum_of(way) + sum_of(*origin);
}

// Stores a ray's direction, limit and doubt. The doubt bounds the errors of fp64 arithmetic.
// Returns the ray's start in normalized coordinates: the point at `near`, advanced to the scene's
// cube if it is far away. A ray that can hit nothing gets a limit below 0.
static Vec3 convert(RayPart *part, size_t entry, const GivenRay *given)
{
    const double largest = vec3_extent(given->direction);
    const bool is_usable = largest >= 1e-300 && sum_of(given->direction) <= 1e300;
    const double shrink = is_usable ? power_to_one(largest) : 0;
    const double unit = shrink * part->inverse_scale;
    const Vec3 direction = vec3_scale(given->direction, shrink);
    double start = given->near;
    Vec3 origin = vec3_scale(vec3_sub(given->origin, part->center), part->scale);
    double sizes = sum_of(origin);
    if (start != 0)
        advance(&origin, direction, start / unit, &sizes);
    if (vec3_extent(origin) > 2 * part->cube) {
        const double ahead = fmax(cube_entry(part->cube, origin, direction), 0);
        advance(&origin, direction, ahead, &sizes);
        start += ahead * unit;
    }
    const double limit = given->far < INFINITY ? (given->far - start) / unit : INFINITY;
    const bool is_ray = is_usable && sum_of(origin) < FARTHEST;
    RayData *ray = &part->rays[entry];
    ray->doubt = is_ray ? (float)(0x1p-50 * sizes) : INFINITY;
    ray->limit = !is_ray || !(given->far >= start) ? -1 : limit < 0x1p127 ? (float)limit : INFINITY;
    vec3_store(ray->direction, direction);
    part->starts[entry] = start;
    part->units[entry] = unit;
    return origin;
}

// Moves the start of a ray onto the plane of its triangle. Returns the former signed distance of
// the start from the plane.
static double move_to_plane(Vec3 *origin, const RayScene *scene, uint32_t triangle)
{
    const FaceCorners corners = corners_of(&scene->form.stages.triangles, triangle);
    const Vec3 normal = normal_of(&corners);
    const double off = vec3_dot(normal, vec3_sub(*origin, corners.at[0]));
    *origin = vec3_sub(*origin, vec3_scale(normal, off));
    return off;
}

static uint64_t primitive_count(const RayPart *part)
{
    const FlatScene *flat = &part->scene->form.flat;
    return (uint64_t)flat->sphere_count + flat->triangle_count;
}

// Makes an entry. Returns the distance of the ray's start from the plane of its triangle, or
// INFINITY if the ray's primitive does not exist.
static double fill_entry(RayPart *part, size_t entry, const GivenRay *given)
{
    RayData *ray = &part->rays[entry];
    const uint32_t spheres = part->scene->form.flat.sphere_count;
    double off = 0;
    Vec3 origin = convert(part, entry, given);
    if (given->own != NOTHING && given->own >= primitive_count(part))
        return INFINITY;
    if (part->start == RAYS_ON_SURFACE && given->own >= spheres && ray->limit >= 0)
        off = fabs(move_to_plane(&origin, part->scene, given->own - spheres));
    ray->own = given->own;
    ray->own_index = NOTHING;
    vec3_store(ray->origin, origin);
    ray->doubt += (float)(1.01 * off + 1.01 * 0x1p-24 * sum_of(origin));
    return off;
}

// Returns half the side of a cube that is about twice as large as the scene.
static double cube_around(const FlatScene *flat)
{
    double cube = LEAST_CUBE;
    for (int axis = 0; axis < 3 && flat->sphere_count > 0; axis++)
        cube = fmax(cube, 2 * fmax(fabs((double)flat->bounds.low[axis]),
                                   fabs((double)flat->bounds.high[axis])));
    return cube;
}

void ray_part_begin(RayPart *part, const Session *session, const RayScene *scene, size_t room)
{
    const Normalization *frame = &session->scene.normalization;
    part->scene = scene;
    part->center = frame->center;
    part->scale = frame->scale;
    part->inverse_scale = 1 / frame->scale;
    part->cube = cube_around(&scene->form.flat);
    part->room = room;
}

// Lists the rays whose kind of start is part->start. A ray whose near is not 0 does not start on
// its primitive, but only skips the primitive.
static void list_entries(RayPart *part, const ClrtRays *rays)
{
    const uint32_t *starts = rays->starts;
    const double *nears = rays->nears;
    part->count = 0;
    for (size_t i = 0; i < part->size; i++) {
        const size_t ray = part->first + part->sequence[i];
        const bool is_on_surface =
            starts != NULL && starts[ray] != NOTHING && (nears == NULL || nears[ray] == 0);
        if (is_on_surface == (part->start == RAYS_ON_SURFACE))
            part->order[part->count++] = part->sequence[i];
    }
}

typedef struct {
    RayPart *part;
    const ClrtRays *rays;
    _Atomic uint32_t first_fault; // the first entry that is not possible
} PartFill;

static void note_fault(PartFill *fill, uint32_t entry)
{
    uint32_t known = atomic_load(&fill->first_fault);
    while (entry < known && !atomic_compare_exchange_weak(&fill->first_fault, &known, entry))
        continue;
}

static void fill_range(void *context, uint32_t first, uint32_t end)
{
    PartFill *fill = context;
    for (uint32_t entry = first; entry < end; entry++) {
        const GivenRay given = given_ray(fill->rays, ray_part_number(fill->part, entry));
        if (fill_entry(fill->part, entry, &given) > OFF_PLANE)
            note_fault(fill, entry);
    }
}

static bool report_fault(RayPart *part, const ClrtRays *rays, uint32_t entry, ClrtError *error)
{
    const size_t number = ray_part_number(part, entry);
    const GivenRay given = given_ray(rays, number);
    const double off = fill_entry(part, entry, &given);
    if (given.own >= primitive_count(part))
        return check_fail(error, CLRT_ARGUMENT, "ray %zu starts on primitive %u of %llu", number,
                          given.own, (unsigned long long)primitive_count(part));
    return check_fail(error, CLRT_ARGUMENT,
                      "ray %zu should start on primitive %u, but starts %.3g from its plane; at "
                      "most %.3g are allowed",
                      number, given.own, off * part->inverse_scale,
                      OFF_PLANE * part->inverse_scale);
}

bool ray_part_fill(RayPart *part, const ClrtRays *rays, ClrtError *error)
{
    PartFill fill = {.part = part, .rays = rays};
    atomic_init(&fill.first_fault, UINT32_MAX);
    list_entries(part, rays);
    thread_pool_share(part->pool, (uint32_t)part->count, RANGE_ENTRIES, fill_range, &fill);
    const uint32_t fault = atomic_load(&fill.first_fault);
    return fault == UINT32_MAX || report_fault(part, rays, fault, error);
}

void ray_part_index(RayPart *part, const RayScene *scene)
{
    const uint32_t spheres = scene->form.flat.sphere_count;
    for (RayData *ray = part->rays; ray < part->rays + part->count; ray++)
        if (part->start == RAYS_ON_SURFACE && ray->own >= spheres && ray->limit >= 0)
            ray->own_index = scene->places[ray->own - spheres].index;
}

// Stores the weights of the second and third corner at the point where the ray's line crosses the
// triangle's plane (Moeller and Trumbore, JGT 2(1) 1997). If the point is outside the triangle, the
// weights are clamped to the triangle.
static void weights_at(double weights[2], const FaceCorners *corners, Vec3 origin, Vec3 direction)
{
    const Vec3 ab = vec3_sub(corners->at[1], corners->at[0]);
    const Vec3 ac = vec3_sub(corners->at[2], corners->at[0]);
    const Vec3 from = vec3_sub(origin, corners->at[0]), across = vec3_cross(direction, ac);
    const double determinant = vec3_dot(ab, across);
    weights[0] = weights[1] = 0;
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

// Stores the properties of a hit's surface.
static void store_surface(const RayScene *scene, const RayData *ray, HitData hit,
                          const ClrtHits *hits, size_t result)
{
    const uint32_t spheres = scene->form.flat.sphere_count;
    const Vec3 origin = vec3_of_floats(ray->origin), direction = vec3_of_floats(ray->direction);
    double weights[2] = {0, 0};
    Vec3 normal = {0, 0, 0};
    if (hit.id != NOTHING && hit.id < spheres) {
        const Vec3 point = vec3_add(origin, vec3_scale(direction, (double)hit.t));
        normal = sphere_normal(&scene->form.flat.spheres[hit.id], point);
    } else if (hit.id != NOTHING) {
        const FaceCorners corners = corners_of(&scene->form.stages.triangles, hit.id - spheres);
        weights_at(weights, &corners, origin, direction);
        normal = normal_of(&corners);
    }
    if (hits->weights != NULL)
        memcpy(hits->weights + 2 * result, weights, sizeof weights);
    if (hits->normals != NULL)
        vec3_store_doubles(hits->normals + 3 * result, normal);
    if (hits->fronts != NULL)
        hits->fronts[result] = hit.id != NOTHING && vec3_dot(normal, direction) <= 0;
}

// Stores the number of a triangle's mesh and the triangle's number in that mesh.
static void store_place(const RayScene *scene, uint32_t id, const ClrtHits *hits, size_t result)
{
    static const TrianglePlace nowhere = {NOTHING, NOTHING, NOTHING};
    const uint32_t spheres = scene->form.flat.sphere_count;
    const TrianglePlace *place =
        id != NOTHING && id >= spheres ? &scene->places[id - spheres] : &nowhere;
    if (hits->meshes != NULL)
        hits->meshes[result] = place->mesh;
    if (hits->triangles != NULL)
        hits->triangles[result] = place->number;
}

// Returns the index of the entry's hit number i in the caller's arrays.
static size_t result_of(const RayPart *part, size_t entry, size_t i)
{
    return ray_part_number(part, entry) * part->room + i;
}

// The hits of a part's entries, and the caller's arrays that receive them.
typedef struct {
    const RayPart *part;
    const HitData *found;
    const ClrtHits *hits;
} PartStore;

static void store_distances(const PartStore *store, uint32_t first, uint32_t end)
{
    const RayPart *part = store->part;
    for (size_t entry = first; entry < end; entry++)
        for (size_t i = 0; i < part->room; i++) {
            const HitData hit = store->found[entry * part->room + i];
            const double distance = part->starts[entry] + (double)hit.t * part->units[entry];
            store->hits->distances[result_of(part, entry, i)] =
                hit.id == NOTHING ? INFINITY : distance;
        }
}

static void store_primitives(const PartStore *store, uint32_t first, uint32_t end)
{
    const RayPart *part = store->part;
    for (size_t entry = first; entry < end; entry++)
        for (size_t i = 0; i < part->room; i++)
            store->hits->primitives[result_of(part, entry, i)] =
                store->found[entry * part->room + i].id;
}

static void store_details(const PartStore *store, uint32_t first, uint32_t end)
{
    const RayPart *part = store->part;
    const ClrtHits *hits = store->hits;
    const bool has_surface = hits->weights != NULL || hits->normals != NULL || hits->fronts != NULL;
    for (size_t entry = first; entry < end; entry++)
        for (size_t i = 0; i < part->room; i++) {
            const HitData hit = store->found[entry * part->room + i];
            const size_t result = result_of(part, entry, i);
            store_place(part->scene, hit.id, hits, result);
            if (has_surface)
                store_surface(part->scene, &part->rays[entry], hit, hits, result);
        }
}

// Separate loops take half the time of a single loop that checks for each hit which arrays to fill.
static void store_range(void *context, uint32_t first, uint32_t end)
{
    const PartStore *store = context;
    const ClrtHits *hits = store->hits;
    if (hits->distances != NULL)
        store_distances(store, first, end);
    if (hits->primitives != NULL)
        store_primitives(store, first, end);
    if (hits->meshes != NULL || hits->triangles != NULL || hits->weights != NULL ||
        hits->normals != NULL || hits->fronts != NULL)
        store_details(store, first, end);
}

void ray_part_store(const RayPart *part, const HitData *found, const ClrtHits *hits)
{
    PartStore store = {part, found, hits};
    thread_pool_share(part->pool, (uint32_t)part->count, RANGE_ENTRIES, store_range, &store);
}
