// SPDX-License-Identifier: MIT
// Mesh -> rays toward its edges and points. An aim is the target of a ray. If the mesh is closed,
// the ray must hit a triangle at the aim or nearer.
//
// A renderer leaks if rounding lets a ray pass between two triangles. Random rays almost never come
// so close to an edge that rounding matters, so the check aims at the edges and points themselves.
// The first rays start at eyes, which are 32 positions around the mesh. If no eye suits an aim, or
// if another part of the mesh hides the aim from its eye, another ray starts near the aim.
//
// Invariant: a ray is cast only if every triangle around its aim clearly faces the ray's origin.
// Rounding then cannot carry the ray past these triangles. In a closed mesh, every miss is
// therefore a leak.
#pragma once

#include "mesh/edges.h"
#include "session/session.h"

typedef enum {
    AIM_UNTRIED, // no ray: the angles are too sharp or the triangles too small
    AIM_REACHED,
    AIM_HIDDEN, // the ray hit something before the aim
    AIM_LEAKED  // the ray passed through the mesh at the aim
} AimState;

// The triangles around an aim.
typedef struct {
    Vec3 outward;      // mean of the normals; unit length
    double facing;     // least cosine between `outward` and a normal
    double size;       // each triangle reaches at least this far from the aim
    uint32_t triangle; // one of the triangles
} Star;

typedef struct {
    Vec3 point; // in normalized coordinates
    Star star;
    float tolerance; // error bound of the hit's t, for the latest ray
    AimState state;
} Aim;

typedef struct {
    Aim *aims;
    size_t count, total; // number of aims in `aims`; number of all aims of the mesh
    Vec3 center;         // center of the mesh's bounds
    double radius;       // radius of a sphere around `center` that contains the mesh
} Aims;

// The input of aims_make. `triangles` holds only this mesh, in normalized coordinates.
typedef struct {
    const Mesh *mesh;
    const Triangles *triangles;
    const Edges *edges;
    bool is_inside_out;
} AimSource;

// Makes an aim at every edge, at every point and just beyond every open edge. If there are more
// than `most` aims, keeps every n-th aim, for the smallest n that suffices.
bool aims_make(Aims *aims, const AimSource *source, size_t most, Error *error);
void aims_free(Aims *aims);

// Both functions store rays that reach their aims at t = 1, and store the index of each ray's aim
// in `targets`. They return the number of rays, which is at most aims->count. aims_shoot_from_close
// skips aims that are reached or leaked.
size_t aims_shoot_from_afar(Aims *aims, RayBlock *blocks, uint32_t *targets);
size_t aims_shoot_from_close(Aims *aims, RayBlock *blocks, uint32_t *targets);

// Sets the state of each aim in `targets` from the hit of its ray.
void aims_judge(Aims *aims, const uint32_t *targets, const HitData *hits, size_t count);
