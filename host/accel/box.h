// SPDX-License-Identifier: MIT
// Operations on axis-aligned boxes.
#pragma once

#include "accel/bvh.h"

// Returns half the surface area; zero for an empty box.
static inline float box_half_area(const Box *box)
{
    const float x = box->high[0] - box->low[0];
    const float y = box->high[1] - box->low[1];
    const float z = box->high[2] - box->low[2];
    return x >= 0 ? x * y + y * z + z * x : 0;
}

// Grows each plane by BVH_SLACK times the box's largest coordinate, rounded outward. The slack
// makes the device's culling conservative (kernels/search.cl).
Box box_grow(const Box *box);
