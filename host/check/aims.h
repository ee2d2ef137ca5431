// SPDX-License-Identifier: MIT
// Mesh -> rays at where its triangles meet, from where every one of them must end on it: first from
// a few eyes around the mesh, as cameras see it, then from close by at what those did not reach.
#pragma once

#include "accel/triangles.h"
#include "check/edges.h"

// As the device reads it; the fourth components are zero.
typedef struct {
    float origin[4];
    float direction[4]; // ends at the aim, at t = 1
} AimRay;

typedef enum {
    AIM_UNTRIED, // too sharp or too small to be aimed at
    AIM_REACHED,
    AIM_HIDDEN, // the ray ended before
    AIM_LEAKED  // the ray went on behind the mesh's surface
} AimState;

typedef struct {
    Vec3 point;        // in the normalized frame
    Vec3 outward;      // mean of the normals around, of length 1
    double facing;     // cosine between it and the normal farthest from it
    double size;       // how far the triangles around reach at least
    uint32_t triangle; // one of them
    float tolerance;   // of t, of the ray last aimed
    AimState state;
    uint32_t eye; // that sees it from afar, EYES of aims.c where none does
} Aim;

typedef struct {
    Aim *aims;
    size_t count, total; // kept, and that the mesh has
    Vec3 center;         // of the mesh
    double radius;       // of a sphere around it
} Aims;

// What aims are made of: triangles are the mesh's alone, in the normalized frame.
typedef struct {
    const Mesh *mesh;
    const Triangles *triangles;
    const Weld *weld;
    const Edges *edges;
    bool is_inside_out;
} AimSource;

// Every edge and every point, and just beyond every edge of a single triangle; where these are more
// than most, evenly chosen ones.
bool aims_make(Aims *aims, const AimSource *source, size_t most, Error *error);
void aims_free(Aims *aims);

// Fill rays, and in targets the numbers of their aims; return how many.  Rays from one eye
// follow each other.
size_t aims_shoot_from_afar(Aims *aims, AimRay *rays, uint32_t *targets);
size_t aims_shoot_from_close(Aims *aims, AimRay *rays, uint32_t *targets);

// Tells each target's state by how far its ray came: t, INFINITY where it met nothing.
void aims_judge(Aims *aims, const uint32_t *targets, const float *distances, size_t count);
