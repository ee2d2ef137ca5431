// SPDX-License-Identifier: MIT
// Finds a ray's hit by testing every triangle in fp64 and, near outlines, in 64 bits of precision.
// Also returns whether the hit is clear: float arithmetic rounds the corners relative to the
// origin, so it cannot resolve an outline closer than its rounding.
#pragma once

#include "ray_batch.h"
#include "stage.h"

typedef struct {
    uint32_t id; // NOTHING where it meets nothing
    double t;    // INFINITY there
    bool clear;
} Verdict;

// The nearest triangle of a scene without spheres; all are two-sided.
Verdict exact_nearest(const Triangles *triangles, const TestRay *ray);

// A single triangle, in 113 bits.
typedef struct {
    bool met;
    double t;        // of the plane
    double distance; // of the ray to the outline, in the sheared plane
    double size;     // the largest sheared coordinate
} ExactMeeting;

ExactMeeting exact_meeting(const float corners[3][3], const TestRay *ray);

// Counts hits that are not what exact_nearest says, where that is clear: a Judgment whose context
// are the Triangles.
size_t exact_count_wrong(void *triangles, const TestRay *rays, const TestHit *hits, size_t count);
