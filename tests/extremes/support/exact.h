// SPDX-License-Identifier: MIT
// Finds a ray's hit by testing every triangle, in long double. The hit is clear unless
// float rounding may decide: at an outline, between two near hits, or at the ray's origin.
#pragma once

#include "ray_batch.h"
#include "stage.h"

typedef struct {
    uint32_t id; // NOTHING without a hit
    double t;    // INFINITY without a hit
    bool clear;
} Verdict;

// Returns the nearest hit in a scene of two-sided triangles without spheres.
Verdict exact_nearest(const Triangles *triangles, const TestRay *ray);

// The result of testing a ray against a single triangle.
typedef struct {
    bool met;
    double t;        // of the hit, if met
    double distance; // from the ray to the outline, at right angles to the direction's longest axis
    double size;     // the largest distance between the ray's origin and a corner along an axis
} ExactMeeting;

ExactMeeting exact_meeting(const Triangles *triangles, size_t triangle, const TestRay *ray);
