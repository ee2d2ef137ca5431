// SPDX-License-Identifier: MIT
// ClrtRays -> the device's rays, and the device's hits -> ClrtHits, one part of a batch at a time.
#pragma once

#include "library/handles.h"

// The largest number of rays in a part.
#define PART_RAYS 16384

// A part of a batch, on its way to the device and back.
typedef struct {
    RayData rays[PART_RAYS];
    double starts[PART_RAYS], units[PART_RAYS]; // the caller's t = starts + units * the device's t
    uint32_t sequence[PART_RAYS]; // order in which ray_part_fill takes rays (ray_grid_order)
    uint32_t order[PART_RAYS];    // by entry: the ray's number in the part
    size_t first, count;          // of the batch's rays
    size_t room;                  // hits stored for each ray
    size_t on_surface;            // the rays of the last on_surface entries start on primitives
} RayPart;

// Fills part->rays with the batch's rays [first, first + count). Fails if a ray starts on a
// primitive that does not exist or is too far from the ray's origin.
bool ray_part_fill(RayPart *part, const ClrtRenderer *renderer, const ClrtRays *rays,
                   ClrtError *error);

// Replaces the indices of the triangles on which rays start by their indices in another layout of
// the scene.
void ray_part_move(RayPart *part, const RayScene *scene);

// Stores the hits, part->room of each entry, in the caller's arrays.
void ray_part_store(const RayPart *part, const RayScene *scene, const HitData *found,
                    const ClrtHits *hits);
