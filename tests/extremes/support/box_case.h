// SPDX-License-Identifier: MIT
// A ray and two boxes: does the device's box test ever miss a box that the ray truly meets?
#pragma once

#include "accel/bvh.h"
#include "ray_batch.h"

typedef struct {
    TestRay ray;
    Box boxes[2]; // not grown
} BoxCase;

// Whether origin + t * direction lies in the box for some t >= 0.  Exact where the differences
// between planes and origin and their products with the direction's components fit 64 bits.
bool box_case_is_met(const TestRay *ray, const Box *box);

// How many boxes the device misses though they are met; adds those that are to *met.  The boxes
// are made into nodes by the host's own code.  The cases are reordered to suit packets.
size_t box_case_count_misses(RayBatch *batch, BoxCase *cases, size_t count, size_t *met);
