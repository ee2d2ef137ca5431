// SPDX-License-Identifier: MIT
// Rays -> hits, computed by the search that renders pictures.
#pragma once

#include "session/session.h"

typedef struct {
    const Kernel *kernel;
    cl_mem rays, hits; // room for one launch
} RayCaster;

// Compiles the session's kernel.
bool ray_caster_open(RayCaster *caster, Session *session, Error *error);
void ray_caster_close(RayCaster *caster);

// How rays start. The values equal those of RayKind in the kernels.
typedef enum {
    RAYS_FREE,      // anywhere
    RAYS_ON_SURFACE // on the primitive that each ray names
} RayStart;

typedef struct {
    const SceneBuffers *scene; // in the node layout of the caster's kernel
    const RayData *rays;
    size_t count;
    RayStart start;
    bool any; // finds whether rays hit anything
} RayCast;

// Stores the nearest hit of each ray, or any hit if this is all that the cast asks for.
bool ray_caster_cast(const RayCaster *caster, const RayCast *cast, HitData *hits, Error *error);

// Finds all triangles that a ray crosses (kernels/crossings.cl).
typedef struct {
    const Kernel *kernel;
    cl_mem rays, hits, counts; // room for one launch
} CrossingFinder;

bool crossing_finder_open(CrossingFinder *finder, Session *session, Error *error);
void crossing_finder_close(CrossingFinder *finder);

// Results for each ray: the number of crossings, and the nearest `room` of them in order.
typedef struct {
    uint32_t *counts;
    HitData *hits; // NULL if room is 0
    uint32_t room; // at most CROSSINGS_MAX
} CrossingList;

#define CROSSINGS_MAX 1048576

bool crossing_finder_find(const CrossingFinder *finder, const RayCast *cast, CrossingList *found,
                          Error *error);
