// SPDX-License-Identifier: MIT
// A mesh and a camera -> where its triangles are seen, cut to the picture and two pixels around it.
#pragma once

#include "base/thread_pool.h"
#include "refine/outline.h"
#include "scene/normalize.h"

typedef struct {
    float x, y;       // in cells of the last level, where it is inside
    uint32_t outside; // a bit for each plane that it is beyond
} ProjectedPoint;

typedef struct {
    const MeshObject *object;
    const Normalization *normalization;
    Vec3 eye, right, down, forward; // right and down give cells of the last level at depth 1
    double width, height;           // of the picture, in cells of the last level
    ProjectedPoint *points;         // of the mesh's vertices
} Projection;

// By a frame's camera, made for REFINE_GRID samples, and of no mesh yet.
Projection projection_of(const FrameData *frame, const Normalization *normalization);

// Projects a mesh's vertices, and forgets them.
bool projection_begin(Projection *projection, const MeshObject *object, ThreadPool *pool,
                      Error *error);
void projection_end(Projection *projection);

// The box around a triangle that is all inside, whichever side it shows; false for others.
bool projection_box(const Projection *projection, size_t triangle, OutlineBox *box);

// False where nothing of the triangle can be seen: it is outside, edge on, or shows its back and
// has but one side.
bool projection_outline(const Projection *projection, size_t triangle, Outline *outline);
