// SPDX-License-Identifier: MIT
// Vectors of 113 bits, for tests of the bounds in docs/numerics.md.
#pragma once

#include "oracle/quad.h"

// The unit roundoff of fp32.
#define U 0x1p-24

static inline Quad magnitude(Quad v)
{
    return v < 0 ? -v : v;
}

static inline Quad larger(Quad a, Quad b)
{
    return a > b ? a : b;
}

static inline Quad smaller(Quad a, Quad b)
{
    return a < b ? a : b;
}

static inline Quad largest3(const Quad v[3])
{
    return larger(larger(magnitude(v[0]), magnitude(v[1])), magnitude(v[2]));
}

static inline Quad dot3(const Quad a[3], const Quad b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline Quad length3(const Quad v[3])
{
    return quad_root(dot3(v, v));
}

static inline void cross3(const Quad a[3], const Quad b[3], Quad product[3])
{
    for (int i = 0; i < 3; i++)
        product[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static inline void subtract3(const Quad a[3], const Quad b[3], Quad difference[3])
{
    for (int i = 0; i < 3; i++)
        difference[i] = a[i] - b[i];
}

// Stores the unit vector of v.
static inline void unit3(const float v[3], Quad unit[3])
{
    const Quad exact[3] = {v[0], v[1], v[2]}, length = length3(exact);
    for (int i = 0; i < 3; i++)
        unit[i] = exact[i] / length;
}
