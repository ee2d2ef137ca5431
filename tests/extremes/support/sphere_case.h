// SPDX-License-Identifier: MIT
// The closed sphere of the watertightness tests at distance 2^exponent, ready to be traced.
#pragma once

#include "room.h"
#include "trial.h"

#define SPHERE_EXPONENTS 24

typedef struct {
    Stage stage;
    Room room; // the cube of half side 1 around its center, as far as that is inside
    Trial trial;
} SphereCase;

// Whether the tier has that exponent: tier 0 has 0, 10 and 18, others all.
bool sphere_case_is_wanted(int exponent);

// S(200), from exponent 20 on S(20): floats are so far apart there that most of the vertices of
// the finer one would fall together.  Uploads it.
void sphere_case_make(SphereCase *sphere, const char *test, RayBatch *batch, int exponent);
void sphere_case_free(SphereCase *sphere);
