// SPDX-License-Identifier: MIT
// ClrtRays -> the device's rays, and the device's hits -> ClrtHits, one part of a batch at a time.
#pragma once

#include "library/handles.h"

// The largest number of rays in a part.
#define PART_RAYS 65536

// A part of a batch, on its way to the device and back. The caller sets `pool`, and ray_part_begin
// sets the members from scene to room. The caller also sets the members from first to start, and
// ray_part_fill sets the others.
typedef struct {
    ThreadPool *pool; // borrowed; converts rays and hits; may be NULL
    const RayScene *scene;
    Vec3 center; // of the scene's normalization, like scale
    double scale, inverse_scale;
    double cube;                  // half the side of the cube to which far origins advance
    size_t room;                  // hits stored for each ray
    size_t first, size;           // index of the part's first ray in the batch; number of the
                                  // part's rays
    uint32_t sequence[PART_RAYS]; // order in which the rays are traced (ray_grid_order)
    RayStart start;               // the entries are the rays with this start
    size_t count;                 // of entries
    uint32_t order[PART_RAYS];    // by entry: the ray's number in the part
    RayData rays[PART_RAYS];
    double starts[PART_RAYS], units[PART_RAYS]; // the caller's t = starts + units * the device's t
} RayPart;

void ray_part_begin(RayPart *part, const Session *session, const RayScene *scene, size_t room);

// Returns the number of an entry's ray in the batch.
static inline size_t ray_part_number(const RayPart *part, size_t entry)
{
    return part->first + part->order[entry];
}

// Makes an entry of each of the part's rays whose kind of start is part->start. Fails if a ray
// starts on a primitive that does not exist or is too far from the ray's origin.
bool ray_part_fill(RayPart *part, const ClrtRays *rays, ClrtError *error);

// Stores in each ray the index of the triangle on which the ray starts. The index refers to the
// device's arrays.
void ray_part_index(RayPart *part, const RayScene *scene);

// Stores the hits, part->room for each entry, in the caller's arrays.
void ray_part_store(const RayPart *part, const HitData *found, const ClrtHits *hits);
