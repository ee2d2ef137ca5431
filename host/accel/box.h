// SPDX-License-Identifier: MIT
// Operations on axis-aligned boxes.
#pragma once

#include "accel/bvh.h"

static inline Box box_empty(void)
{
    return (Box){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
}

static inline void box_include(Box *box, const Box *other)
{
    for (int axis = 0; axis < 3; axis++) {
        box->low[axis] = other->low[axis] < box->low[axis] ? other->low[axis] : box->low[axis];
        box->high[axis] = other->high[axis] > box->high[axis] ? other->high[axis] : box->high[axis];
    }
}

static inline void box_include_point(Box *box, const float point[3])
{
    for (int axis = 0; axis < 3; axis++) {
        box->low[axis] = point[axis] < box->low[axis] ? point[axis] : box->low[axis];
        box->high[axis] = point[axis] > box->high[axis] ? point[axis] : box->high[axis];
    }
}

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
