// SPDX-License-Identifier: MIT
// ClrtRays -> the device's rays; the device's hits -> ClrtHits. One part of a batch is converted at
// a time.
#pragma once

#include "library/handles.h"

// The largest number of rays in a part.
#define PART_RAYS 65536

// Converts distances: the caller's t = (start + the device's t) * unit.
typedef struct {
    double start, unit;
} RayScale;

// The caller's arrays for results.
typedef struct {
    RayQuery query; // RAYS_NEAREST or RAYS_ALL
    ClrtHits hits;  // for RAYS_NEAREST, room is 1, and counts is NULL
    uint8_t *flags; // the results of clrt_occluded or clrt_contains; may be NULL
} RayResults;

// A batch of rays, and arrays for its present part. Entry i of the arrays belongs to ray first +
// order[i] of the batch.
typedef struct RayBatch {
    ClrtRays rays;
    RayResults results;
    RayCast cast;          // of the part
    const RayScene *scene; // of the cast
    ThreadPool *pool;      // converts rays and hits
    double unit;           // length of a normalized unit in scene units
    double cube;           // half the side of the cube to which far origins advance
    size_t first;          // the part's first ray
    uint32_t order[PART_RAYS];
    RayData data[PART_RAYS];
    RayScale scales[PART_RAYS];
    double offs[PART_RAYS]; // distances of starts from their triangles; unset without `starts`
    uint32_t counts[PART_RAYS];
    HitData found[HITS_MAX]; // results.hits.room hits per entry
} RayBatch;

// A ray from the caller's arrays.
typedef struct {
    Vec3 origin, direction;
    double near, far;
    uint32_t own; // the primitive on which the ray starts; CLRT_NOTHING for none
} GivenRay;

// Returns the ray with this index. Arrays that the caller omits have their default values.
GivenRay given_ray(const ClrtRays *rays, size_t index);

// Fills `data` and `scales` for the cast. Fails if a primitive in `starts` does not exist, or if it
// is a triangle whose plane is too far from the ray's origin.
bool ray_batch_convert(RayBatch *batch, ClrtError *error);

// Stores the results of the cast, in `found` and `counts`, in the caller's arrays.
void ray_batch_store(RayBatch *batch);
