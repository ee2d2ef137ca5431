// SPDX-License-Identifier: MIT
// clrt traces scenes in normalized coordinates. The scene is moved to the origin in fp64 and scaled
// by a power of two. The bits of float coordinates then describe the geometry, not its place.
//
// Floats are dense only near the origin. At a distance of 1e6, neighboring floats differ by 1/16,
// which would destroy the details of a mesh of size 1. The center is therefore subtracted in fp64,
// before coordinates are rounded to float. Scaling by a power of two changes only exponents, so it
// rounds nothing.
//
// Invariant: a scene that is moved, or scaled by a power of two, keeps its normalized coordinates
// except for rounding in fp64. Only this rounding can change the picture.
#pragma once

#include "scene/scene.h"

// A point's normalized coordinates are (point - center) * scale.
typedef struct {
    Vec3 center;
    double scale; // a power of two
} Normalization;

// Returns the normalization that centers the triangles' bounding box and scales its longest side
// into [1, 2). Spheres count only in scenes without triangles, because a ground sphere of radius
// 1e9 would leave too few bits for a mesh. Rays of the library use this normalization.
Normalization normalization_of_primitives(const Scene *scene);

// Returns the normalization for pictures. This is normalization_of_primitives, except in some
// scenes without triangles. In these scenes, the box is thousands of times as large as a camera's
// distance from the visible objects, and several times as large as the box of all eyes
// (normalize.c). The center is then between the eyes.
Normalization normalization_of(const Scene *scene);

// Returns the longest side of the box that normalization_of scales, or a negative number if the box
// is empty.
double normalization_extent(const Scene *scene);

Vec3 normalize_point(const Normalization *normalization, Vec3 point);

// Suns are placed at this normalized distance, the largest that the kernels allow. Within the
// normalized box, the direction to a sun differs by less than 2^-39 from the direction at the
// center. This is far below the rounding of fp32, so suns need no kernel of their own.
#define SUN_DISTANCE 0x1p40

// Returns the normalized position of a point light or sun.
Vec3 normalize_light(const Normalization *normalization, const Light *light);

// Sets check_rate and check_shift of a material with a checker, so that the pattern stays in place.
// Changes no other material.
void normalize_checker(Material *material, const Normalization *normalization);

// Returns the scene coordinates of a normalized point.
Vec3 denormalize_point(const Normalization *normalization, Vec3 point);

// Returns whether the kernels can trace the scene. The normalized coordinates of point lights, eyes
// and sphere centers must be in [-2^40, 2^40], and normalized radii in [2^-40, 2^40]. For
// orthographic cameras, the normalized height must be in [2^-40, 2^20], and the normalized width at
// most 2^20. Outside these ranges, the kernels' floats could overflow or underflow.
bool normalization_check(const Normalization *normalization, const Scene *scene, Error *error);

// Returns false with a note if floats are too coarse for a camera, because the scene has small and
// very distant parts. Rounding may then move the eye by more than 2^-12 of its distance from the
// look-at point, and of its distance from the nearest surface. For orthographic cameras, the
// picture's height replaces these distances.
bool normalization_is_fine(const Normalization *normalization, const Scene *scene, Error *note);
