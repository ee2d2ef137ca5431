// SPDX-License-Identifier: MIT
// The smallest axis-aligned box around points in fp64.
#pragma once

#include "base/vec.h"

typedef struct {
    Vec3 low, high; // INFINITY and -INFINITY if the box is empty
} BoundingBox;

static inline BoundingBox bounding_box_empty(void)
{
    return (BoundingBox){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
}

static inline void bounding_box_add(BoundingBox *box, Vec3 point)
{
    box->low = vec3_lower(box->low, point);
    box->high = vec3_upper(box->high, point);
}

static inline Vec3 bounding_box_sides(const BoundingBox *box)
{
    return vec3_sub(box->high, box->low);
}

static inline Vec3 bounding_box_center(const BoundingBox *box)
{
    return vec3_scale(vec3_add(box->low, box->high), 0.5);
}
