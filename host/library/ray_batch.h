// SPDX-License-Identifier: MIT
// ClrtRays -> the device's rays. One part of a batch is converted at a time.
#pragma once

#include "base/thread_pool.h"
#include "library/handles.h"

#include <math.h>

// The largest number of rays in a part.
#define PART_RAYS 65536

// The number of consecutive entries that a thread converts. It is a multiple of RAY_BLOCK.
#define RANGE_ENTRIES 1024

// Compiles a function twice, for processors with and without AVX2. With AVX2, calls for camera rays
// take 6 % less time. Both variants contain the INLINED functions that they call. Builds for
// ThreadSanitizer have a single variant, because the loader would choose a variant before
// ThreadSanitizer is ready, and crash.
#if defined __x86_64__ && !defined __SANITIZE_THREAD__
#define FOR_AVX2_TOO __attribute__((target_clones("avx2", "default")))
#else
#define FOR_AVX2_TOO
#endif
#define INLINED static inline __attribute__((always_inline))

// The caller's arrays for results.
typedef struct {
    RayQuery query; // RAYS_NEAREST or RAYS_ALL
    ClrtHits hits;  // for RAYS_NEAREST, room is 1, and counts is NULL
    uint8_t *flags; // the results of clrt_occluded or clrt_contains; may be NULL
} RayResults;

// A batch of rays, and arrays for its present part. Entry i of the arrays belongs to ray first +
// order[i] of the batch, or to ray first + i if !is_ordered.
typedef struct RayBatch {
    ClrtRays rays;
    RayResults results;
    RayCaster *caster;     // has the part's rays, and results.hits.room hits per entry
    RayCast cast;          // of the part
    const RayScene *scene; // of the cast
    ThreadPool *pool;      // converts rays and hits
    double unit;           // length of a normalized unit in scene units
    double cube;           // half the side of the cube to which far origins advance
    size_t first;          // the part's first ray
    bool is_ordered;
    uint32_t order[PART_RAYS];
    double starts[PART_RAYS], units[PART_RAYS]; // the caller's t = (start + the device's t) * unit
    double offs[PART_RAYS]; // distances of starts from their triangles; unset without `starts`
} RayBatch;

// A ray from the caller's arrays.
typedef struct {
    Vec3 origin, direction;
    double near, far;
} GivenRay;

INLINED Vec3 given_vector(const double *vectors, size_t stride, size_t index)
{
    const size_t bytes = index * (stride != 0 ? stride : 3 * sizeof(double));
    return vec3_of_doubles((const double *)(const void *)((const char *)vectors + bytes));
}

// Returns the ray with this index. Arrays that the caller omits have their default values.
INLINED GivenRay given_ray(const ClrtRays *rays, size_t index)
{
    return (GivenRay){given_vector(rays->origins, rays->origin_stride, index),
                      rays->directions != NULL
                          ? given_vector(rays->directions, rays->direction_stride, index)
                          : vec3(0, 0, 1),
                      rays->nears != NULL ? rays->nears[index] : 0,
                      rays->fars != NULL ? rays->fars[index] : INFINITY};
}

// Returns the number of an entry's ray in the batch. Entries past the part's end repeat its last
// ray.
INLINED size_t ray_of(const RayBatch *batch, size_t entry)
{
    const size_t last = batch->cast.count - 1, index = entry < last ? entry : last;
    return batch->first + (batch->is_ordered ? batch->order[index] : index);
}

typedef struct {
    Vec3 at[3], normal;
} Face;

INLINED Face face_of(const RayScene *scene, uint32_t id)
{
    const Triangles *triangles = &scene->form.stages.triangles;
    const size_t triangle = id - scene->form.flat.sphere_count;
    const Vec3 a = vec3_of_floats(triangles_corner(triangles, triangle, 0));
    const Vec3 b = vec3_of_floats(triangles_corner(triangles, triangle, 1));
    const Vec3 c = vec3_of_floats(triangles_corner(triangles, triangle, 2));
    return (Face){{a, b, c}, vec3_normalize(vec3_cross(vec3_sub(b, a), vec3_sub(c, a)))};
}

INLINED Vec3 point_at(Vec3 origin, Vec3 direction, double t)
{
    return vec3_add(origin, vec3_scale(direction, t));
}

// Fills the caster's rays, `starts` and `units` for the cast. Fails if a primitive in `starts` does
// not exist, or if it is a triangle whose plane is too far from the ray's origin.
bool ray_batch_convert(RayBatch *batch, ClrtError *error);
