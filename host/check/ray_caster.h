// SPDX-License-Identifier: MIT
// FlatScene and rays -> how far each ray comes, by the search that draws pictures.
#pragma once

#include "check/aims.h"
#include "render/ready_kernel.h"

typedef struct {
    const Device *device; // borrowed
    NodeLayout nodes;
    Program program;
    cl_kernel kernel;
    cl_mem rays, distances;             // room for one launch
    cl_mem spheres, nodes_array, faces; // of the scene that is loaded
    FrameData frame;
} RayCaster;

// Compiles the kernel; a scene is to be loaded before rays are cast.
bool ray_caster_open(RayCaster *caster, const RendererSetup *setup, Error *error);
void ray_caster_close(RayCaster *caster);

// Takes another scene, laid out for the nodes of the choice, in place of the one before.  It is
// unloaded before it is freed, and in either case.
bool ray_caster_load(RayCaster *caster, const FlatScene *flat, Error *error);
void ray_caster_unload(RayCaster *caster);

// Fills distances: t of each ray, INFINITY where it meets nothing.
bool ray_caster_cast(const RayCaster *caster, const AimRay *rays, size_t count, float *distances,
                     Error *error);
