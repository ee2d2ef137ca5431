// SPDX-License-Identifier: MIT
// clrt traces scenes in normalized coordinates: moved to the origin in fp64 and scaled by a power
// of two. Float then uses all its bits for the geometry.
//
// Floats are dense near the origin only. At a distance of 1e6 from it, they are 1/16 apart, and the
// details of a mesh of size 1 would be rounded away. The center is therefore subtracted in fp64,
// before coordinates become floats. A power of two changes only exponents, so scaling does not
// round.
//
// Invariant: moving a scene, or scaling it by a power of two, keeps its normalized coordinates,
// apart from rounding in fp64, and therefore its picture.
#pragma once

#include "scene/scene.h"

// A point's normalized coordinates are (point - center) * scale.
typedef struct {
    Vec3 center;
    double scale; // a power of two
} Normalization;

// Returns the normalization that centers the triangles' bounding box and scales its longest side
// into [1, 2). Only scenes without triangles use the spheres' box, because a ground sphere of
// radius 1e9 would leave a mesh too few bits.
Normalization normalization_of(const Scene *scene);

// Returns the longest side of the box that normalization_of scales; negative without such a box.
double scene_extent(const Scene *scene);

Vec3 normalize_point(const Normalization *normalization, Vec3 point);

// Returns the scene coordinates of a normalized point.
Vec3 denormalize_point(const Normalization *normalization, Vec3 point);

// Fails if a normalized coordinate of a light, eye or sphere center is outside [-2^40, 2^40], or a
// normalized radius is outside [2^-40, 2^40]. Beyond that, float could overflow or underflow.
bool normalization_check(const Normalization *normalization, const Scene *scene, Error *error);
