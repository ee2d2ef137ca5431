// SPDX-License-Identifier: MIT
// Rays -> hit distances, computed by the traversal that renders pictures. The rays meet a scene of
// the caster's own, not the session's.
#pragma once

#include "session/session.h"

typedef struct {
    const Kernel *kernel;
    cl_mem rays, distances; // room for one launch
    SceneBuffers scene;
} RayCaster;

// Compiles the session's kernel. To cast rays, callers also load a scene.
bool ray_caster_open(RayCaster *caster, Session *session, Error *error);
void ray_caster_close(RayCaster *caster);

// Replaces the scene. flat must have the node layout of caster->kernel. Callers call
// ray_caster_unload before they free flat, also after a failed load.
bool ray_caster_load(RayCaster *caster, const FlatScene *flat, Error *error);
void ray_caster_unload(RayCaster *caster);

// Stores the hit distance t of each ray in distances, or INFINITY for a miss.
bool ray_caster_cast(const RayCaster *caster, const CastRay *rays, size_t count, float *distances,
                     Error *error);
