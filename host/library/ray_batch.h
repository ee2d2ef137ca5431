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
    ClrtHits hits;  // room is 1 for RAYS_NEAREST
    uint8_t *flags; // the results of clrt_occluded or clrt_contains; may be NULL
} RayResults;

// A batch of rays, and arrays for its present part. Entry i of the arrays belongs to ray first +
// order[i] of the batch.
typedef struct RayBatch {
    ClrtRays rays;
    RayResults results;
    ThreadPool *pool;      // converts rays and hits; may be NULL
    const RayScene *scene; // of the present cast
    double unit;           // length of a normalized unit in scene units
    double cube;           // half the side of the cube to which far origins advance
    bool finds_doubts;     // computes RayData::doubt
    size_t first, count;   // the first ray and the number of rays of the part
    atomic_bool is_faulty; // a ray's `starts` is invalid
    uint32_t order[PART_RAYS];
    RayData data[PART_RAYS];
    RayScale scales[PART_RAYS];
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

// Fills `data` and `scales` for a cast in the scene. Only RAYS_CERTAIN needs doubts. Calls for
// camera rays take 1 to 3 % less time without them. Fails if a primitive in `starts` does not
// exist, or if it is a triangle whose plane is too far from the ray's origin.
bool ray_batch_convert(RayBatch *batch, const RayScene *scene, bool finds_doubts, ClrtError *error);

// Stores the results from `found` and `counts` in the caller's arrays.
void ray_batch_store(RayBatch *batch);
