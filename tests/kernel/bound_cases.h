// SPDX-License-Identifier: MIT
// Rays and triangles for test_bounds, the same in each run.
#pragma once

#include "scene/scene.h"

typedef struct {
    float origin[3], direction[3];
} Line;

// Makes a random ray and triangle. Some rays hit the triangle, some have directions near (1, 1, 1),
// and some have coordinates so small that errors of products underflow.
void bound_case_make(Line *line, TriangleData *triangle);

// Changes one to four numbers of a case.
void bound_case_change(Line *line, TriangleData *triangle);

// Returns a random integer below count.
uint32_t bound_case_choose(uint32_t count);
