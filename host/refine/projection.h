// SPDX-License-Identifier: MIT
// Projects a mesh's triangles into the picture, clipped to the picture and a margin of two pixels.
#pragma once

#include "base/parallel.h"
#include "refine/outline.h"
#include "scene/normalize.h"

typedef struct {
    float x, y;       // in cells of the last level, if outside is 0
    uint32_t outside; // a bit for each clipping plane that the point is beyond
} ProjectedPoint;

typedef struct {
    const MeshObject *object;
    const Normalization *normalization;
    Vec3 eye, right, down, forward; // right and down give cells of the last level at depth 1
    double width, height;           // of the picture, in cells of the last level
    ProjectedPoint *points;         // of the mesh's vertices
} Projection;

// Returns the projection of a frame's camera, which must be made for REFINE_GRID samples, and of no
// mesh yet.
Projection projection_of(const FrameData *frame, const Normalization *normalization);

// Project a mesh's vertices, and free them.
bool projection_begin(Projection *projection, const MeshObject *object, Crew *crew, Error *error);
void projection_end(Projection *projection);

// Computes the box around a triangle, front or back. Returns false if the triangle is partly
// outside.
bool projection_box(const Projection *projection, size_t triangle, OutlineBox *box);

// Returns false if the triangle is invisible: it is outside, seen edge-on, or one-sided and seen
// from behind.
bool projection_outline(const Projection *projection, size_t triangle, Outline *outline);
