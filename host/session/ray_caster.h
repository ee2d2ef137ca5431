// SPDX-License-Identifier: MIT
// Rays -> hits, computed by the search that renders pictures.
#pragma once

#include "session/session.h"

// The kernels that trace arrays of rays.
typedef enum {
    RAYS_NEAREST, // kernels/rays.cl: the nearest hit, or whether there is one
    RAYS_CROSSED, // kernels/crossings.cl: the number of crossings, and the nearest ones in order
    RAYS_CERTAIN, // kernels/certify_rays.cl: the hits that rounding cannot change; needs pair nodes
    RAY_QUERIES
} RayQuery;

typedef struct {
    const Kernel *kernel;
    cl_mem rays, hits, counts; // room for one cast; counts is NULL unless RAYS_CROSSED
} RayCaster;

// Compiles the query's kernel. Fails for RAYS_CERTAIN if certifier_check_device rejects the device.
bool ray_caster_open(RayCaster *caster, Session *session, RayQuery query, Error *error);
void ray_caster_close(RayCaster *caster);

// Where rays start. The values equal RAY_CAMERA and RAY_REFLECTED of the kernels' RayKind.
typedef enum {
    RAYS_FREE,      // anywhere
    RAYS_ON_SURFACE // on the primitives that the rays name
} RayStart;

typedef struct {
    const SceneBuffers *scene; // in the node layout of the caster's kernel
    const RayData *rays;
    size_t count; // in [1, CAST_RAYS]
    RayStart start;
    bool any;      // for RAYS_NEAREST: any hit suffices
    uint32_t room; // for RAYS_CROSSED: hits stored for each ray; at most CROSSINGS_MAX / count
} RayCast;

#define CAST_RAYS     262144
#define CROSSINGS_MAX 1048576

// Stores the hits of the rays. For RAYS_CROSSED, stores the numbers of crossings in `counts`, and
// `hits` may be NULL if room is 0. For other queries, `counts` may be NULL.
bool ray_caster_cast(const RayCaster *caster, const RayCast *cast, HitData *hits, uint32_t *counts,
                     Error *error);
