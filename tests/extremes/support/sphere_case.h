// SPDX-License-Identifier: MIT
// The closed sphere of the watertightness tests at distance 2^exponent, ready to be traced.
#pragma once

#include "ray_batch.h"
#include "room.h"

#define SPHERE_EXPONENTS 24

typedef struct {
    Stage stage;
    Room room; // the cube of half side 1 around its center, as far as that is inside
} SphereCase;

// S(200), from exponent 20 on S(20): floats are so far apart there that most of the vertices of
// the finer one would fall together.  Uploads it.
void sphere_case_make(SphereCase *sphere, RayBatch *batch, int exponent);
void sphere_case_free(SphereCase *sphere);
