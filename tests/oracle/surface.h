// SPDX-License-Identifier: MIT
// Computes the surface at a hit of the oracle: its point, orientation and object.
#pragma once

#include "oracle/blocks.h"

typedef struct {
    Vec3 point;
    Vec3 normal; // interpolated, of length 1
    Vec3 face;   // unit normal of the true surface, toward the viewer
    Vec3 toward_viewer;
    double near; // rays from this point ignore nearer hits
    uint32_t id, material;
    uint32_t object; // the sphere's index, or the mesh's index plus the count of spheres
    bool front;
    bool odd;  // in an odd cube of a checker
    Vec3 body; // the diffuse color
} OracleSurface;

OracleSurface surface_at(const Scene *scene, const OracleRay *ray, OracleHit hit);

// Returns whether the surface itself occludes a light in this direction. In the renderers of the
// course (docs/scenes.md), shadow rays start at a small distance from the point. In the limit of
// distance zero, the surface near the point is its tangent plane. The plane occludes the light
// unless light and viewer are on the same side.
bool surface_blocks(const OracleSurface *surface, Vec3 toward_light);
