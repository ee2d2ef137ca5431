// SPDX-License-Identifier: MIT
// Rays from inside closed shapes far from the origin must all hit the shape.
#pragma once

#include "rig.h"
#include "shapes.h"

// Bits of a set of aims. CLOSED_AIMS contains random rays, edges and rounded vertices.
#define CLOSED_AIM(aim) (1u << (aim))
#define CLOSED_AIMS     (CLOSED_AIM(AIM_RANDOM) | CLOSED_AIM(AIM_EDGES) | CLOSED_AIM(AIM_VERTICES))

typedef struct {
    const char *test;
    const char *label; // starts the details of each case
    uint64_t seed;     // for exponent 0
    unsigned aims;     // bits of CLOSED_AIM
    size_t rays;       // per aim
} ClosedTest;

// Returns a sphere at shape_center(exponent). It has 200 rings, or 20 if exponent is 20 or more,
// because floats there are too far apart for most vertices of a finer sphere.
Scene closed_sphere(int exponent);

// Traces rays from around shape_center(exponent), the center of the closed scene, and reports rays
// that miss. Frees the scene.
void closed_judge(RayBatch *batch, Scene scene, int exponent, const ClosedTest *test);

// Calls closed_judge for closed spheres of exponents 0, 10 and 18 at tier 0, else of 0 to 23.
void closed_judge_spheres(RayBatch *batch, const ClosedTest *test);
