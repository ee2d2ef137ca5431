// SPDX-License-Identifier: MIT
// A hit of the oracle becomes a surface: where it is, how it is turned, and whose it is.
#pragma once

#include "oracle/blocks.h"

typedef struct {
    Vec3 point;
    Vec3 normal; // unit, interpolated
    Vec3 face;   // unit, of the true surface, toward the viewer
    Vec3 toward_viewer;
    double near; // where rays that leave the point begin to count
    uint32_t id, material;
    uint32_t object; // the sphere, or the mesh counted after the spheres
    bool front;
} OracleSurface;

OracleSurface surface_at(const Scene *scene, const OracleRay *ray, OracleHit hit);

// Whether the surface itself stands between its point and a light in this direction.  The course
// starts the ray to a light a little off the point.  As that distance shrinks, the surface there
// becomes its tangent plane, which stops the ray unless light and viewer are on one side of it.
bool surface_blocks(const OracleSurface *surface, Vec3 toward_light);
