// SPDX-License-Identifier: MIT
// Grows boxes around points and other boxes.
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
