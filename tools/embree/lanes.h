// SPDX-License-Identifier: MIT
// Vectors of LANES numbers, one per ray of a packet, and points made of such vectors. The vectors
// have the compiler's vector types, so + - * / work on all lanes at once.
#pragma once

#include <math.h>
#include <stdint.h>

typedef float Floats __attribute__((vector_size(4 * LANES)));
typedef int32_t Mask __attribute__((vector_size(4 * LANES))); // -1 for true, 0 for false

typedef struct {
    Floats x, y, z;
} Points;

static inline Floats all(float value)
{
    return value - (Floats){0};
}

static inline Floats choose(Mask mask, Floats yes, Floats no)
{
    return (Floats)((mask & (Mask)yes) | (~mask & (Mask)no));
}

static inline Floats at_least(Floats a, Floats b)
{
    return choose(a > b, a, b);
}

static inline Floats at_most(Floats a, Floats b)
{
    return choose(a < b, a, b);
}

static inline int lanes_of(Mask mask)
{
    int count = 0;
    for (int lane = 0; lane < LANES; lane++)
        count -= mask[lane];
    return count;
}

static inline Floats inverse_root(Floats value)
{
    Floats result;
    for (int lane = 0; lane < LANES; lane++)
        result[lane] = 1 / sqrtf(value[lane]);
    return result;
}

static inline Points points_all(const float point[3])
{
    return (Points){all(point[0]), all(point[1]), all(point[2])};
}

static inline Points points_add(Points a, Points b)
{
    return (Points){a.x + b.x, a.y + b.y, a.z + b.z};
}

static inline Points points_subtract(Points a, Points b)
{
    return (Points){a.x - b.x, a.y - b.y, a.z - b.z};
}

static inline Points points_scale(Points a, Floats factor)
{
    return (Points){a.x * factor, a.y * factor, a.z * factor};
}

static inline Floats points_dot(Points a, Points b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline Points points_unit(Points a)
{
    return points_scale(a, inverse_root(points_dot(a, a)));
}

static inline Points points_choose(Mask mask, Points yes, Points no)
{
    return (Points){choose(mask, yes.x, no.x), choose(mask, yes.y, no.y),
                    choose(mask, yes.z, no.z)};
}
