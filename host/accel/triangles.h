// SPDX-License-Identifier: MIT
// Scene -> Triangles: the corners of all triangles in id order, as the floats that are traced.
// Equal points give equal floats, which watertightness and the builders rest on.
#pragma once

#include "base/parallel.h"
#include "scene/normalize.h"

typedef struct {
    float (*corners)[3][3]; // [triangle][corner][axis], in [-1, 1]; owned
    size_t count;
} Triangles;

// The n-th triangle here is the scene's n-th in file order.
bool triangles_make(Triangles *triangles, const Scene *scene, const Normalization *normalization,
                    Crew *crew, Error *error);
void triangles_free(Triangles *triangles);

// How far ahead of their use to fetch triangles that are read in no order.
#define TRIANGLES_AHEAD 16

static inline void triangles_fetch(const Triangles *triangles, uint32_t triangle)
{
    const char *corners = (const char *)triangles->corners[triangle];
    __builtin_prefetch(corners);
    __builtin_prefetch(corners + sizeof triangles->corners[0] - 1);
}
