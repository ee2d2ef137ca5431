// SPDX-License-Identifier: MIT
// Mesh -> the number of rays that pass through it at its edges and points. The mesh is traced alone
// and two-sided, in its scene's frame.
#pragma once

#include "check/aims.h"
#include "check/census.h"
#include "render/ready_kernel.h"

// FlatScene and rays -> hit distances, computed by the traversal that renders pictures.

// Rays need three of the arrays that flat_arrays lists: spheres, nodes and triangles.
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

// Stores the hit distance t of each ray in distances, or INFINITY for a miss.
bool ray_caster_cast(const RayCaster *caster, const AimRay *rays, size_t count, float *distances,
                     Error *error);

// The largest number of aims per mesh that get rays.
#define LEAKS_AIMS 1048576

typedef struct {
    size_t total;    // aims of the mesh (aims.h): edges, points and positions beyond open edges
    size_t aimed;    // aims that got a ray
    size_t rays;     // rays cast; some aims got two
    size_t hidden;   // aims behind other parts of the mesh
    MeshFault leaks; // rays that passed through; first: a triangle there, by its number in the file
} LeakCount;

typedef struct {
    const Normalization *normalization;
    const Closedness *closedness; // of the mesh
    ThreadPool *pool;
    BvhBuilder builder;
    bool uses_bvh;
} LeakSetting;

bool leaks_count(LeakCount *count, RayCaster *caster, const MeshObject *given,
                 const LeakSetting *setting, Error *error);
