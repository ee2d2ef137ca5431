// SPDX-License-Identifier: MIT
// Scene -> the frame it is traced in: moved to the origin in fp64 and scaled by a power of two, so
// that float keeps all its bits for the geometry.  A scene moved or scaled as a whole gives the
// same numbers here, hence the same picture.
#pragma once

#include "scene/scene.h"

// A point in the frame is (point - center) * scale.
typedef struct {
    Vec3 center;
    double scale; // a power of two
} Normalization;

// Centers the bounds of the triangles (of the spheres where there are none) and brings their
// largest side into [1, 2).  Lights, eyes and the other spheres may lie outside: a ground sphere
// of radius 1e9 must not push the mesh into its last bits.
Normalization normalization_of(const Scene *scene);

Vec3 normalize_point(const Normalization *normalization, Vec3 point);

// The point in the scene's own coordinates of one in the frame.
Vec3 denormalize_point(const Normalization *normalization, Vec3 point);

// Fails where a light, an eye or a sphere is so far from the geometry, or a sphere so much smaller
// or larger than it, that float arithmetic would overflow (a ratio past 2^40).
bool normalization_check(const Normalization *normalization, const Scene *scene, Error *error);
