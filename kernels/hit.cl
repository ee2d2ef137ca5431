// SPDX-License-Identifier: MIT
// A ray's hit, and the rule that decides between hits at equal distances.
#ifndef CLRT_HIT_CL
#define CLRT_HIT_CL
#include "numeric.cl"

// `index` is the position in the array of spheres or of triangles. With wide nodes, the position of
// a triangle is block * WIDE + slot. Spheres have the ids below sphere_count.
typedef struct {
    Real t; // along the ray; INFINITY without a hit
    UInt id, index;
} Hit;

// Returns *hit, read member by member, which is faster on PoCL (see read3).
static inline Hit read_hit(const Hit *hit)
{
    return (Hit){hit->t, hit->id, hit->index};
}

// Returns whether a primitive at the distance t precedes the best hit. At equal distances, the
// lowest id wins, so the order of the tests does not matter. For triangles at almost equal
// distances, order.cl decides instead.
static inline Mask hit_precedes(Real t, UInt id, const Hit *best)
{
    return t < best->t || (t == best->t && id < best->id && t < INFINITY);
}

#endif
