// SPDX-License-Identifier: MIT
// Projects a mesh's triangles into the picture, clipped to the picture and a margin of two pixels.
#pragma once

#include "base/parallel.h"
#include "refine/outline.h"
#include "scene/normalize.h"

typedef struct {
    float x, y;       // in cells of the last level, if outside is 0
    uint32_t outside; // bit i: the point is beyond clipping plane i
} ProjectedPoint;

typedef struct {
    const MeshObject *object;
    const Normalization *normalization;
    Vec3 eye, right, down, forward; // dot products with right and down are in cells of the last
                                    // level at depth 1
    double width, height;           // of the picture, in cells of the last level
    ProjectedPoint *points;         // of the mesh's vertices
} Projection;

// Returns a projection without a mesh. The frame's camera must be made for REFINE_GRID samples.
Projection projection_of(const FrameData *frame, const Normalization *normalization);

// projection_begin projects the vertices of a mesh. projection_end frees them.
bool projection_begin(Projection *projection, const MeshObject *object, Crew *crew, Error *error);
void projection_end(Projection *projection);

// Computes the box around a triangle, seen from either side. Returns false if a corner is beyond a
// clipping plane.
bool projection_box(const Projection *projection, size_t triangle, OutlineBox *box);

// Computes the clipped outline of a triangle. Returns false if the triangle is outside, seen
// edge-on, or one-sided and seen from behind.
bool projection_outline(const Projection *projection, size_t triangle, Outline *outline);
