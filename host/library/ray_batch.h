// SPDX-License-Identifier: MIT
// ClrtRays -> the device's rays, and the device's hits -> ClrtHits, one part of a batch at a time.
#pragma once

#include "library/handles.h"

// The largest number of rays in a part.
#define PART_RAYS 65536

// The caller's t = (start + the device's t) * unit.
typedef struct {
    double start, unit;
} RayScale;

// The caller's arrays for results.
typedef struct {
    RayQuery query; // RAYS_NEAREST or RAYS_ALL
    ClrtHits hits;  // room is 1 for RAYS_NEAREST
    uint8_t *flags; // whether a ray is occluded, or starts inside; may be NULL
} RayResults;

// A batch, of which one part is on its way to the device and back. Entry i of the arrays is for ray
// first + order[i] of the batch.
typedef struct RayBatch {
    ClrtRays rays;
    RayResults results;
    ThreadPool *pool;      // converts rays and hits; may be NULL
    const RayScene *scene; // of the present cast
    double unit;           // length of a normalized unit
    double cube;           // half the side of the cube to which far origins advance
    size_t first, count;   // rays of the part
    atomic_bool is_faulty; // a ray starts on an impossible primitive
    uint32_t order[PART_RAYS];
    RayData data[PART_RAYS];
    RayScale scales[PART_RAYS];
    uint32_t counts[PART_RAYS];
    HitData found[HITS_MAX]; // results.hits.room for each entry
} RayBatch;

// Returns the length of the rows if the rays form a grid. In a grid, the points at t = 1 advance in
// one direction and jump back at the end of each row. Returns 0 for other rays.
size_t ray_batch_width(const ClrtRays *rays);

// Fills order for a part, in blocks of 64 rays of a grid. Rows that fill no block come last. If
// width is 0, the numbers ascend. The order changes no bit of the hits.
void ray_batch_order(RayBatch *batch, size_t width);

// Fills data and scales for a cast in the scene. Fails if a ray starts on a primitive that does not
// exist or is too far from the ray's origin.
bool ray_batch_convert(RayBatch *batch, const RayScene *scene, ClrtError *error);

// Stores the results that found and counts contain in the caller's arrays.
void ray_batch_store(RayBatch *batch);
