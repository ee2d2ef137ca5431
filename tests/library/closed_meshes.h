// SPDX-License-Identifier: MIT
// Ten closed meshes of different shapes. Their coordinates are multiples of 2^-20 in [-1, 1], so
// that floats hold them exactly and 128-bit integers hold their determinants.
#pragma once

#include <stddef.h>
#include <stdint.h>

#define CLOSED_MESHES 10
#define CLOSED_BUMPY  1 // the number of a bumpy ball, which is far from convex

// The number of coordinate units in a length of 1.
#define GRID 1048576

typedef struct {
    const char *name;
    int32_t (*vertices)[3]; // in units of 1 / GRID
    uint32_t (*faces)[3];
    size_t vertex_count, face_count;
} ClosedMesh;

// Makes mesh `number`, counted from 0. Any failure ends the test.
ClosedMesh closed_mesh_make(int number);
void closed_mesh_free(ClosedMesh *mesh);

// Returns the positions of the vertices. The caller frees them.
typedef double Position[3];
Position *closed_mesh_positions(const ClosedMesh *mesh);
