// SPDX-License-Identifier: MIT
// The normalized frame in which a scene is traced: moved to the origin in fp64 and scaled by a
// power of two, so that float keeps all its bits for the geometry. A scene moved or scaled as a
// whole has the same numbers in the frame, and thus the same picture.
#pragma once

#include "scene/scene.h"

// A point in the frame is (point - center) * scale.
typedef struct {
    Vec3 center;
    double scale; // a power of two
} Normalization;

// Centers the bounds of the triangles (of the spheres if there are none) and scales their largest
// side into [1, 2). Lights, eyes and the other spheres may lie outside. Otherwise a ground sphere
// of radius 1e9 would push the mesh into the last bits.
Normalization normalization_of(const Scene *scene);

Vec3 normalize_point(const Normalization *normalization, Vec3 point);

// Converts a point in the frame to the scene's own coordinates.
Vec3 denormalize_point(const Normalization *normalization, Vec3 point);

// Fails if float arithmetic would overflow (a ratio past 2^40): a light, an eye or a sphere is too
// far from the geometry, or a sphere is too small or too large for it.
bool normalization_check(const Normalization *normalization, const Scene *scene, Error *error);
