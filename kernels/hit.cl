// SPDX-License-Identifier: MIT
// A ray's hit, and how ties between hits are decided.
#ifndef CLRT_HIT_CL
#define CLRT_HIT_CL
#include "numeric.cl"

// index is the position in the array of spheres or of triangles. With wide nodes, the position of a
// triangle is block * WIDE + slot. Spheres have the ids below sphere_count.
typedef struct {
    Real t; // along the ray; INFINITY without a hit
    UInt id, index;
} Hit;

// Equal distances go to the lowest id, regardless of the order of the tests. Triangles at almost
// equal distances are ordered by order.cl before.
static inline Mask hit_precedes(Real t, UInt id, const Hit *best)
{
    return t < best->t || (t == best->t && id < best->id && t < INFINITY);
}

#endif
