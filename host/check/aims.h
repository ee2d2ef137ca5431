// SPDX-License-Identifier: MIT
// Mesh -> rays at its edges and points, each of which must end on a triangle there.  The first rays
// come from a few eyes around the mesh, as cameras see it.  Aims that these do not reach get a
// second ray from close by.
#pragma once

#include "accel/triangles.h"
#include "check/edges.h"

// The device's layout; the fourth components are zero.
typedef struct {
    float origin[4];
    float direction[4]; // ends at the aim, at t = 1
} AimRay;

typedef enum {
    AIM_UNTRIED, // too sharp or too small for a ray
    AIM_REACHED,
    AIM_HIDDEN, // the ray ended before the aim
    AIM_LEAKED  // the ray continued behind the mesh's surface
} AimState;

typedef struct {
    Vec3 point;        // in the normalized frame
    Vec3 outward;      // mean of the normals around the aim, of length 1
    double facing;     // cosine between outward and the normal farthest from it
    double size;       // lower bound on the extent of the triangles around
    uint32_t triangle; // one of the triangles around
    float tolerance;   // in t, of the latest ray
    AimState state;
    uint32_t eye; // the eye that sees the aim from afar; EYES of aims.c for none
} Aim;

typedef struct {
    Aim *aims;
    size_t count, total; // aims kept, aims of the mesh
    Vec3 center;         // of the mesh
    double radius;       // of a sphere around it
} Aims;

// The input for aims.  triangles holds the mesh alone, in the normalized frame.
typedef struct {
    const Mesh *mesh;
    const Triangles *triangles;
    const Weld *weld;
    const Edges *edges;
    bool is_inside_out;
} AimSource;

// Makes an aim at every edge, at every point and just beyond every open edge.  Above most aims, it
// keeps an evenly spaced subset.
bool aims_make(Aims *aims, const AimSource *source, size_t most, Error *error);
void aims_free(Aims *aims);

// Fill rays, and targets with the numbers of their aims; return the number of rays.  Rays from one
// eye are consecutive.
size_t aims_shoot_from_afar(Aims *aims, AimRay *rays, uint32_t *targets);
size_t aims_shoot_from_close(Aims *aims, AimRay *rays, uint32_t *targets);

// Sets each target's state from its ray's hit distance t, which is INFINITY for a miss.
void aims_judge(Aims *aims, const uint32_t *targets, const float *distances, size_t count);
