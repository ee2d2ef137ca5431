// SPDX-License-Identifier: MIT
// Rays -> hits, computed by the searches that render pictures.
#pragma once

#include "device/buffer.h"
#include "session/session.h"

// The kernels that trace arrays of rays.
typedef enum {
    RAYS_NEAREST, // kernels/rays.cl: the nearest hit, or whether there is one
    RAYS_ALL,     // kernels/rays.cl: the number of hits, and the nearest ones in order
    RAYS_CERTAIN, // kernels/certify_rays.cl: whether the hits of RAYS_NEAREST are independent of
                  // rounding
    RAY_QUERIES
} RayQuery;

typedef struct {
    uint32_t index;  // in the device's arrays
    uint32_t mesh;   // number of the mesh
    uint32_t number; // in the mesh as given, counting the triangles that clrt drops
} TrianglePlace;

// A scene for rays, in device buffers that kernels search and as triangles on the host.
typedef struct {
    SceneForm form;        // form.stages has the traced triangles in the order of their ids
    Normalization frame;   // of the primitives alone, so that rays do not depend on cameras
    TrianglePlace *places; // by triangle, in the order of ids; owned
    bool one_sided;
} RayScene;

// An array of the host, and the buffer that kernels use.
typedef struct {
    void *data;
    cl_mem buffer;
} CastArray;

// An empty caster, without kernels, buffers and scenes, is {0}.
typedef struct {
    const Kernel *kernels[RAY_QUERIES]; // by query, from its last ray_caster_open
    CastArray blocks;                   // of RayBlock, for CAST_RAYS rays
    CastArray hits;                     // of HitData, for HITS_MAX hits
    CastArray counts;                   // of uint32_t, for CAST_RAYS rays
    RayScene scenes[NODE_LAYOUTS];
} RayCaster;

// Makes the query's kernel, for scenes with or without spheres, and the buffers, unless they exist.
// Without spheres, compiling takes 0.85 times as long as with spheres. Fails for RAYS_CERTAIN if
// certifier_check_device rejects the device.
bool ray_caster_open(RayCaster *caster, Session *session, RayQuery query, bool has_spheres,
                     Error *error);
void ray_caster_close(RayCaster *caster);

// Calls ray_caster_open, and returns the session's scene in the node layout of the query's kernel,
// or NULL on failure. Compiles the scene unless the caster has it with this value of `one_sided`.
// If `one_sided` is false, rays hit all triangles from both sides.
const RayScene *ray_caster_scene(RayCaster *caster, Session *session, RayQuery query,
                                 bool one_sided, Error *error);

// Releases the scenes. Callers must call this function before the session's scene changes.
void ray_caster_free_scenes(RayCaster *caster);

typedef struct {
    RayQuery query;
    const SceneBuffers *scene; // in the node layout of the query's kernel
    cl_uint count;             // of rays, in [1, CAST_RAYS]
    cl_uint kinds;             // only for RAYS_NEAREST: RAY_ON_SURFACE, RAY_ANY_HIT
    cl_uint room; // hits stored for each ray: 1, or for RAYS_ALL at most HITS_MAX / count
} RayCast;

#define CAST_RAYS 262144
#define HITS_MAX  1048576

// Casts the rays in caster->blocks. Stores the hits in caster->hits and, for RAYS_ALL, the numbers
// of hits in caster->counts. For RAYS_CERTAIN, stores in caster->counts which hits of the preceding
// cast are certain. The preceding cast must have been RAYS_NEAREST with the same rays.
bool ray_caster_cast(const RayCaster *caster, const RayCast *cast, Error *error);
