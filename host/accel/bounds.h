// SPDX-License-Identifier: MIT
// Boxes as a vector of low planes and a vector of negated high planes. The union of two boxes is
// then one minimum per vector. No plane is -0, so the order of unions does not matter.
#pragma once

#include "accel/bvh.h"

#ifdef __SSE__
#include <xmmintrin.h>
#endif

typedef float Float4 __attribute__((vector_size(16)));
typedef uint32_t Uint4 __attribute__((vector_size(16)));

typedef struct {
    Float4 low, negated_high; // x, y, z; BuildItem keeps its integers in the fourth component
} Bounds;

// The element that builders sort: a triangle, or a grid cell with several triangles (cells.h).
typedef union {
    Bounds bounds;
    struct {
        float low[3];
        uint32_t number;
        float negated_high[3];
        uint32_t weight; // number of triangles
    };
} BuildItem;

static inline Float4 float4_minimum(Float4 a, Float4 b)
{
#ifdef __SSE__
    return _mm_min_ps(a, b);
#else
    Float4 minimum;
    for (int i = 0; i < 4; i++)
        minimum[i] = a[i] < b[i] ? a[i] : b[i];
    return minimum;
#endif
}

static inline Bounds bounds_empty(void)
{
    const Float4 nowhere = {INFINITY, INFINITY, INFINITY, INFINITY};
    return (Bounds){nowhere, nowhere};
}

static inline void bounds_unite(Bounds *bounds, const Bounds *other)
{
    bounds->low = float4_minimum(bounds->low, other->low);
    bounds->negated_high = float4_minimum(bounds->negated_high, other->negated_high);
}

static inline float bounds_extent(const Bounds *bounds, int axis)
{
    return -(bounds->low[axis] + bounds->negated_high[axis]);
}

// Returns half the surface area; INFINITY for empty bounds.
static inline float bounds_half_area(const Bounds *bounds)
{
    const Float4 sides = bounds->low + bounds->negated_high;
    return sides[0] * sides[1] + sides[1] * sides[2] + sides[2] * sides[0];
}

// Returns half the surface area of each of three bounds. The fourth component repeats the third.
static inline Float4 bounds_half_areas(const Bounds bounds[3])
{
    const Float4 a = bounds[0].low + bounds[0].negated_high;
    const Float4 b = bounds[1].low + bounds[1].negated_high;
    const Float4 c = bounds[2].low + bounds[2].negated_high;
    const Float4 ab = __builtin_shufflevector(a, b, 0, 4, 1, 5);
    const Float4 x = __builtin_shufflevector(ab, c, 0, 1, 4, 4);
    const Float4 y = __builtin_shufflevector(ab, c, 2, 3, 5, 5);
    const Float4 z =
        __builtin_shufflevector(__builtin_shufflevector(a, b, 2, 6, 2, 6), c, 0, 1, 6, 6);
    return x * y + y * z + z * x;
}

static inline Box bounds_box(const Bounds *bounds)
{
    Box box;
    for (int axis = 0; axis < 3; axis++) {
        box.low[axis] = bounds->low[axis];
        box.high[axis] = 0 - bounds->negated_high[axis];
    }
    return box;
}

static inline Float4 float4_corner(const Triangles *triangles, uint32_t triangle, int corner)
{
    const float *point = triangles_corner(triangles, triangle, corner);
    return (Float4){point[0], point[1], point[2], point[3]};
}

static inline Bounds bounds_of_triangle(const Triangles *triangles, uint32_t triangle)
{
    const Float4 zero = {0}, a = float4_corner(triangles, triangle, 0),
                 b = float4_corner(triangles, triangle, 1),
                 c = float4_corner(triangles, triangle, 2);
    // Adding zero turns -0 into 0.
    return (Bounds){float4_minimum(float4_minimum(a, b), c) + zero,
                    float4_minimum(float4_minimum(-a, -b), -c) + zero};
}

// Returns the bounds of a single point: the doubled center (low + high) of the given bounds.
static inline Bounds bounds_of_center(const Bounds *bounds)
{
    return (Bounds){bounds->low - bounds->negated_high, bounds->negated_high - bounds->low};
}

// Returns the item's doubled center on an axis.
static inline float item_center(const BuildItem *item, int axis)
{
    return item->low[axis] - item->negated_high[axis];
}
