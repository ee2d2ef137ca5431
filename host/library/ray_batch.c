// SPDX-License-Identifier: MIT
// Callers pass rays in fp64 and in scene coordinates. The device receives them in float and in
// normalized coordinates. A ray's direction is scaled by a power of two so that its largest
// component is in [1, 2). The device's t then stays in the range of floats. An origin is far if the
// magnitude of a coordinate exceeds the side of a cube around the scene. Rounding such an origin to
// float would move the ray too far, so the origin first advances to the cube.
//
// The threads of a pool share the conversions, because a single thread would limit a device with
// many cores to about 50 million rays per second.
//
// Invariant: each conversion depends only on the ray and the scene, so a ray has the same hit in
// every batch.
#include "library/ray_batch.h"

#include <string.h>

// The smallest value of RayBatch::cube. All triangles are within [-1, 1] on each axis.
#define LEAST_CUBE 2.0

// The largest normalized distance of a ray's start from the plane of the triangle in `starts`.
#define OFF_PLANE 0x1p-15

// Rays that start beyond this distance from the normalized origin hit nothing (intersect.cl). Only
// rays that miss the cube around the scene start there, because the limits of spheres (normalize.h)
// keep every cube within this distance.
#define FARTHEST 0x1p45

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
INLINED double sum_of(Vec3 v)
{
    return fabs(v.x) + fabs(v.y) + fabs(v.z);
}

// Returns the power of two that scales a size from [1e-300, 1e300] into [1, 2). The bit operations
// replace ilogb and scalbn. With fmax, these functions took 15 % of a batch's processor time.
INLINED double power_to_one(double size)
{
    uint64_t bits;
    double power;
    memcpy(&bits, &size, sizeof bits);
    bits = (UINT64_C(2046) << 52) - (bits & UINT64_C(0x7ff) << 52);
    memcpy(&power, &bits, sizeof power);
    return power;
}

typedef struct {
    double x[RAY_BLOCK], y[RAY_BLOCK], z[RAY_BLOCK];
} Vectors;

// The rays of a block in fp64, by component. The compiler turns loops over a block into vector
// code.
typedef struct {
    Vectors origin, direction;
    Vectors from; // where the device's rays start
    double near[RAY_BLOCK], limit[RAY_BLOCK];
} WideRays;

INLINED Vec3 vector_of(const Vectors *vectors, size_t i)
{
    return vec3(vectors->x[i], vectors->y[i], vectors->z[i]);
}

INLINED void set_vector(Vectors *vectors, size_t i, Vec3 v)
{
    vectors->x[i] = v.x;
    vectors->y[i] = v.y;
    vectors->z[i] = v.z;
}

INLINED void round_vector(float components[3][RAY_BLOCK], size_t i, Vec3 v)
{
    components[0][i] = (float)v.x;
    components[1][i] = (float)v.y;
    components[2][i] = (float)v.z;
}

INLINED void read_rays(const RayBatch *batch, size_t first, WideRays *rays)
{
    for (size_t i = 0; i < RAY_BLOCK; i++) {
        const GivenRay given = given_ray(&batch->rays, ray_of(batch, first + i));
        set_vector(&rays->origin, i, given.origin);
        set_vector(&rays->direction, i, given.direction);
        rays->near[i] = given.near;
        rays->limit[i] = given.far;
    }
}

// Scales the directions, normalizes the origins, and stores the units. If a direction is not
// usable, the origin becomes NaN.
INLINED void normalize_rays(const RayBatch *batch, WideRays *rays, double units[RAY_BLOCK])
{
    const Normalization frame = batch->scene->frame;
    const double scene_unit = batch->unit;
    for (size_t i = 0; i < RAY_BLOCK; i++) {
        const Vec3 direction = vector_of(&rays->direction, i);
        const double largest = vec3_extent(direction);
        const bool is_usable = (largest >= 1e-300) & (sum_of(direction) <= 1e300);
        const double shrink = power_to_one(largest), scale = is_usable ? frame.scale : NAN;
        const Vec3 origin = vec3_scale(vec3_sub(vector_of(&rays->origin, i), frame.center), scale);
        units[i] = shrink * scene_unit;
        set_vector(&rays->direction, i, vec3_scale(direction, shrink));
        set_vector(&rays->origin, i, origin);
        set_vector(&rays->from, i, origin);
    }
}

// Moves the starts of rays to the points at `near`. Far starts move further along the ray, to the
// cube around the scene.
INLINED void start_rays(const RayBatch *batch, WideRays *rays, double starts[RAY_BLOCK],
                        const double units[RAY_BLOCK])
{
    const double farthest = 2 * batch->cube;
    memset(starts, 0, RAY_BLOCK * sizeof *starts);
    for (size_t i = 0; batch->rays.nears != NULL && i < RAY_BLOCK; i++)
        if (rays->near[i] != 0) {
            starts[i] = rays->near[i] / units[i];
            set_vector(
                &rays->from, i,
                point_at(vector_of(&rays->origin, i), vector_of(&rays->direction, i), starts[i]));
        }
    uint64_t is_far = 0;
    for (size_t i = 0; i < RAY_BLOCK; i++)
        is_far |= vec3_extent(vector_of(&rays->from, i)) > farthest ? 1 : 0;
    for (size_t i = 0; is_far && i < RAY_BLOCK; i++)
        if (vec3_extent(vector_of(&rays->from, i)) > farthest && rays->near[i] > -INFINITY) {
            const Vec3 origin = vector_of(&rays->origin, i);
            const Vec3 direction = vector_of(&rays->direction, i);
            starts[i] = fmax(starts[i], cube_entry(batch->cube, origin, direction));
            set_vector(&rays->from, i, point_at(origin, direction, starts[i]));
        }
    for (size_t i = 0; batch->rays.fars != NULL && i < RAY_BLOCK; i++)
        if (rays->limit[i] != INFINITY)
            rays->limit[i] = rays->limit[i] / units[i] - starts[i];
}

// Rounds the rays. A ray that can hit nothing gets a limit below 0.
INLINED void round_rays(const WideRays *rays, RayBlock *block)
{
    for (size_t i = 0; i < RAY_BLOCK; i++) {
        const Vec3 from = vector_of(&rays->from, i);
        const double limit = rays->limit[i];
        const bool is_ray = (sum_of(from) < FARTHEST) & (limit >= 0);
        const double clamped = limit < 0x1p127 ? limit : INFINITY;
        round_vector(block->origin, i, from);
        round_vector(block->direction, i, vector_of(&rays->direction, i));
        block->limit[i] = (float)(is_ray ? clamped : -1.0);
    }
    memset(block->own, -1, sizeof block->own);
    memset(block->own_index, -1, sizeof block->own_index);
}

// Returns a bound on the distance of a ray's stored origin from its exact start. `off` is the
// distance by which the start was moved. Errors of fp64 arithmetic are at most 2^-52 of the
// coordinates of the given origin and of the start. Rounding to float adds 2^-24 of the start. The
// bound is infinite if the ray's numbers are not usable.
static float doubt_of(const WideRays *rays, size_t i, double off)
{
    const double size = sum_of(vector_of(&rays->from, i));
    const double whole = size + sum_of(vector_of(&rays->origin, i));
    const double doubt = 0x1p-50 * whole + 1.01 * off + 1.01 * 0x1p-24 * size;
    return size < FARTHEST ? (float)doubt : INFINITY;
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

// Lets a ray skip the primitive `own`, and lets it start there if near is 0. Returns the distance
// by which the ray's start moves, or INFINITY if the primitive does not exist.
static double leave_primitive(const RayBatch *batch, uint32_t own, WideRays *rays, size_t i,
                              RayBlock *block)
{
    const RayScene *scene = batch->scene;
    const uint32_t spheres = scene->form.flat.sphere_count;
    block->own[i] = own;
    if (own == NOTHING)
        return 0;
    if (own >= primitive_count(scene))
        return INFINITY;
    if (rays->near[i] != 0)
        return 0;
    block->own_index[i] = own < spheres ? own : scene->places[own - spheres].index;
    if (own < spheres || block->limit[i] < 0)
        return 0;
    Vec3 start = vector_of(&rays->from, i);
    const double off = move_to_plane(batch, own, &start);
    set_vector(&rays->from, i, start);
    round_vector(block->origin, i, start);
    return off;
}

INLINED void convert(RayBatch *batch, size_t first)
{
    WideRays rays;
    RayBlock *block = (RayBlock *)batch->caster->blocks.data + first / RAY_BLOCK;
    double *units = batch->units + first;
    read_rays(batch, first, &rays);
    normalize_rays(batch, &rays, units);
    start_rays(batch, &rays, batch->starts + first, units);
    round_rays(&rays, block);
    const uint32_t *owns = batch->rays.starts;
    for (size_t i = 0; owns != NULL && i < RAY_BLOCK; i++)
        batch->offs[first + i] =
            leave_primitive(batch, owns[ray_of(batch, first + i)], &rays, i, block);
    for (size_t i = 0; batch->cast.query == RAYS_CERTAIN && i < RAY_BLOCK; i++)
        block->doubt[i] = doubt_of(&rays, i, owns != NULL ? batch->offs[first + i] : 0);
}

FOR_AVX2_TOO static void convert_range(void *context, uint32_t first, uint32_t end)
{
    for (uint32_t entry = first; entry < end; entry += RAY_BLOCK)
        convert(context, entry);
}

static bool check_start(const RayBatch *batch, size_t entry, ClrtError *error)
{
    const double off = batch->offs[entry];
    const size_t number = ray_of(batch, entry);
    const uint32_t own = batch->rays.starts[number];
    if (off == INFINITY)
        return library_fail(error, CLRT_ARGUMENT, "ray %zu starts on primitive %u of %llu", number,
                            own, (unsigned long long)primitive_count(batch->scene));
    return !(off > OFF_PLANE) ||
           library_fail(error, CLRT_ARGUMENT,
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
