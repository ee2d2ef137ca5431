// SPDX-License-Identifier: MIT
// Collects a scene's triangles in file order, with the float coordinates that the device traces.
// Equal points get equal floats, so closed meshes stay closed.
#pragma once

#include "base/thread_pool.h"
#include "scene/normalize.h"

#include <stdbool.h>
#include <stdint.h>

// The order of a triangle's corners on the device (kernels/shared.h).
typedef struct {
    uint8_t places[3]; // places in the file, 0 to 2, of the corners sorted by x, then y, then z
    bool reversed;     // sorting swaps front and back
} CornerOrder;

extern const CornerOrder corner_orders[8];

// Returns the index in corner_orders of the order that sorts the corners a, b and c.
uint8_t corner_order(const float *a, const float *b, const float *c);

typedef struct {
    float (*points)[4];     // vertices of all meshes, normalized; the fourth component is zero
    uint32_t (*corners)[3]; // by triangle: indices of its points, in file order
    uint8_t *orders;        // by triangle: index into corner_orders
    size_t count, point_count;
} Triangles;

// Returns false if memory runs out or the scene has too many triangles, spheres or vertices.
bool triangles_make(Triangles *triangles, const Scene *scene, const Normalization *normalization,
                    ThreadPool *pool, Error *error);
void triangles_free(Triangles *triangles);

static inline const CornerOrder *triangles_order(const Triangles *triangles, size_t triangle)
{
    return &corner_orders[triangles->orders[triangle]];
}

static inline const float *triangles_corner(const Triangles *triangles, size_t triangle, int corner)
{
    return triangles->points[triangles->corners[triangle][corner]];
}
