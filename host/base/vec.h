// SPDX-License-Identifier: MIT
// Three-component vectors in fp64, for parsing and setup on the host.
#pragma once

#include <math.h>

typedef struct {
    double x, y, z;
} Vec3;

static inline Vec3 vec3(double x, double y, double z)
{
    return (Vec3){x, y, z};
}

static inline Vec3 vec3_of_floats(const float v[3])
{
    return (Vec3){(double)v[0], (double)v[1], (double)v[2]};
}

static inline Vec3 vec3_of_doubles(const double v[3])
{
    return (Vec3){v[0], v[1], v[2]};
}

static inline void vec3_store_doubles(double out[3], Vec3 v)
{
    out[0] = v.x;
    out[1] = v.y;
    out[2] = v.z;
}

// Rounds the components to float.
static inline void vec3_store(float out[3], Vec3 v)
{
    out[0] = (float)v.x;
    out[1] = (float)v.y;
    out[2] = (float)v.z;
}

static inline Vec3 vec3_add(Vec3 a, Vec3 b)
{
    return (Vec3){a.x + b.x, a.y + b.y, a.z + b.z};
}

static inline Vec3 vec3_sub(Vec3 a, Vec3 b)
{
    return (Vec3){a.x - b.x, a.y - b.y, a.z - b.z};
}

static inline Vec3 vec3_scale(Vec3 a, double s)
{
    return (Vec3){a.x * s, a.y * s, a.z * s};
}

static inline double vec3_dot(Vec3 a, Vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline Vec3 vec3_cross(Vec3 a, Vec3 b)
{
    return (Vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// The squares of the components must neither overflow nor underflow.
static inline double vec3_length(Vec3 a)
{
    return sqrt(vec3_dot(a, a));
}

// Return the smaller or the larger of each pair of components. The vectors must not contain NaN.
// fmin and fmax would be slower, because they are function calls.
static inline Vec3 vec3_lower(Vec3 a, Vec3 b)
{
    return (Vec3){a.x < b.x ? a.x : b.x, a.y < b.y ? a.y : b.y, a.z < b.z ? a.z : b.z};
}

static inline Vec3 vec3_upper(Vec3 a, Vec3 b)
{
    return (Vec3){a.x > b.x ? a.x : b.x, a.y > b.y ? a.y : b.y, a.z > b.z ? a.z : b.z};
}

// Returns the largest absolute value of the components, none of which should be a NaN.
static inline double vec3_extent(Vec3 a)
{
    const double x = fabs(a.x), y = fabs(a.y), z = fabs(a.z), larger = x > y ? x : y;
    return larger > z ? larger : z;
}

// Returns `a` scaled to length 1; the zero vector stays zero. If squares could overflow or
// underflow, `a` is first divided by a power of two, which adds no rounding error.
static inline Vec3 vec3_normalize(Vec3 a)
{
    const double square = vec3_dot(a, a);
    if (square > 0x1p-900 && square < 0x1p900)
        return vec3_scale(a, 1 / sqrt(square));
    const double extent = vec3_extent(a);
    if (!(extent > 0))
        return (Vec3){0, 0, 0};
    const int exponent = ilogb(extent);
    const Vec3 unit = {scalbn(a.x, -exponent), scalbn(a.y, -exponent), scalbn(a.z, -exponent)};
    return vec3_scale(unit, 1 / sqrt(vec3_dot(unit, unit)));
}

// Return the sine and cosine of `degrees`, which must be below 1e9 in magnitude. The error is at
// most 2 ulp, and results at multiples of 90 are exact. The C library's functions would make the
// camera depend on whether the processor has fma.
double sine_of_degrees(double degrees);
double cosine_of_degrees(double degrees);

// Returns the angle between vectors of length 1, in radians. The error is at most 2^-48.
double angle_between(Vec3 a, Vec3 b);
