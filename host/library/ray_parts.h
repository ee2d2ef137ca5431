// SPDX-License-Identifier: MIT
// Converts the rays of clrt.h to the device's, and hits back.
#pragma once

#include "library/handles.h"

// Rays in one part of a batch.
#define PART_RAYS 16384

// A part of a batch, on its way to the device and back.
typedef struct {
    RayData rays[PART_RAYS];
    double starts[PART_RAYS], units[PART_RAYS]; // a hit at t is at starts + t * units of the caller
    uint32_t order[PART_RAYS];                  // the ray of the part that each entry is for
    size_t first, count;                        // of the batch's rays
} RayPart;

// Fills part->rays with the rays [first, first + count). The last rays are those that start on
// primitives; *on_surface receives their number. Fails if a ray cannot start where it says.
bool ray_part_fill(RayPart *part, const ClrtRenderer *renderer, const ClrtRays *rays,
                   size_t *on_surface, ClrtError *error);

// A hit of an entry of the part, and the place of its results in the caller's arrays.
typedef struct {
    size_t entry, place;
    HitData hit;
} PartHit;

// Stores a hit in the caller's arrays.
void ray_part_store(const RayPart *part, const ClrtRenderer *renderer, const PartHit *hit,
                    const ClrtHits *hits);
