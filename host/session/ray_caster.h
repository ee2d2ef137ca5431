// SPDX-License-Identifier: MIT
// Rays -> hits, computed by the searches that render pictures.
#pragma once

#include "session/session.h"

// The kernels that trace arrays of rays.
typedef enum {
    RAYS_NEAREST, // kernels/rays.cl: the nearest hit, or whether there is one
    RAYS_ALL,     // kernels/rays.cl: the number of hits, and the nearest ones in order
    RAYS_CERTAIN, // kernels/certify_rays.cl: whether rounding cannot change RAYS_NEAREST's hits
    RAY_QUERIES
} RayQuery;

typedef struct {
    uint32_t index;  // in the device's arrays
    uint32_t mesh;   // number of the mesh
    uint32_t number; // in the mesh as given, counting the triangles that clrt drops
} TrianglePlace;

// A scene for rays, in device buffers that kernels search and as triangles on the host.
typedef struct {
    SceneForm form;        // its triangles are as traced, in the order of their ids
    Normalization frame;   // of the primitives alone, so that rays do not depend on cameras
    TrianglePlace *places; // of the triangles
    bool is_loaded, one_sided;
} RayScene;

// {0} has no kernels, buffers and scenes.
typedef struct {
    const Kernel *kernels[RAY_QUERIES]; // for the scene of the last ray_caster_open
    cl_mem rays, hits, counts;          // room for one cast
    RayScene scenes[NODE_LAYOUTS];
} RayCaster;

// Makes the query's kernel, for scenes with or without spheres, and the buffers, unless they exist.
// Without spheres, the kernel compiles in 0.85 of the time. Fails for RAYS_CERTAIN if
// certifier_check_device rejects the device.
bool ray_caster_open(RayCaster *caster, Session *session, RayQuery query, bool has_spheres,
                     Error *error);
void ray_caster_close(RayCaster *caster);

// Opens the query and returns the session's scene in the node layout of its kernel, or NULL on
// failure. Compiles the scene unless the caster has it with this value of one_sided. If one_sided
// is false, rays hit all triangles from both sides.
const RayScene *ray_caster_scene(RayCaster *caster, Session *session, RayQuery query,
                                 bool one_sided, Error *error);

// Releases the scenes. The session's scene may change afterwards.
void ray_caster_free_scenes(RayCaster *caster);

typedef struct {
    RayQuery query;
    const SceneBuffers *scene; // in the node layout of the query's kernel
    const RayData *rays;
    size_t count;     // in [1, CAST_RAYS]
    bool on_surfaces; // only for RAYS_NEAREST: some rays start on primitives
    bool any;         // only for RAYS_NEAREST: any hit suffices
    cl_uint room;     // hits stored for each ray: 1, or for RAYS_ALL at most HITS_MAX / count
    HitData *hits;    // may be NULL for RAYS_CERTAIN
    uint32_t *counts; // may be NULL for RAYS_NEAREST
} RayCast;

#define CAST_RAYS 262144
#define HITS_MAX  1048576

// Stores the hits and, for RAYS_ALL, the numbers of hits. For RAYS_CERTAIN, stores in counts which
// hits of the preceding cast are certain. It must have been RAYS_NEAREST with the same rays.
bool ray_caster_cast(const RayCaster *caster, const RayCast *cast, Error *error);
