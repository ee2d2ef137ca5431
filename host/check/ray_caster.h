// SPDX-License-Identifier: MIT
// FlatScene and rays -> hit distances, computed by the traversal that renders pictures.
#pragma once

#include "check/aims.h"
#include "render/ready_kernel.h"

// The arrays of flat_arrays that rays need: spheres, nodes and triangles.
#define CASTER_FIRST  2
#define CASTER_ARRAYS 3

typedef struct {
    const Device *device; // borrowed
    NodeLayout nodes;
    Program program;
    cl_kernel kernel;
    cl_mem rays, distances;       // buffers for one launch
    cl_mem arrays[CASTER_ARRAYS]; // of the loaded scene
    FrameData frame;
} RayCaster;

// Compiles the kernel. To cast rays, callers also load a scene.
bool ray_caster_open(RayCaster *caster, const RendererSetup *setup, Error *error);
void ray_caster_close(RayCaster *caster);

// Replaces the loaded scene. flat must have the node layout of the setup's kernel choice. Callers
// call ray_caster_unload before they free flat, also after a failed load.
bool ray_caster_load(RayCaster *caster, const FlatScene *flat, Error *error);
void ray_caster_unload(RayCaster *caster);

// Stores the hit distance t of each ray in distances; INFINITY for a miss.
bool ray_caster_cast(const RayCaster *caster, const AimRay *rays, size_t count, float *distances,
                     Error *error);
