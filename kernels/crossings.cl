// SPDX-License-Identifier: MIT
// Records all hits of rays. In programs with CLRT_ALL_HITS, searches add each hit to its ray's
// list, and never shorten a ray. If a ray hits closed surfaces an odd number of times, it starts
// inside.
//
// A ray through an edge or a vertex hits several triangles there. If all of them counted, the
// parity could be wrong. A triangle therefore counts only if it owns the ray. edges_own decides as
// if the ray were moved by an infinitely small distance in a fixed direction (Edelsbrunner and
// Muecke, "Simulation of simplicity", 1990).
//
// Invariant: if a ray crosses a closed surface at an edge or vertex, an odd number of the triangles
// there own the ray. If the ray only touches the surface there, the number is even.
#ifndef CLRT_CROSSINGS_CL
#define CLRT_CROSSINGS_CL
#include "ray.cl"

#if CLRT_ALL_HITS

static inline bool precedes(const HitData *a, const HitData *b)
{
    return a->t < b->t || (a->t == b->t && a->id < b->id);
}

// Counts a hit of ray number `ray`, and inserts it into the ray's sorted list.
static inline void add_crossing(const HitLists *lists, uint ray, HitData hit)
{
    global HitData *nearest = lists->hits + (size_t)ray * lists->room;
    uint place = min(lists->counts[ray]++, lists->room);
    for (; place > 0; place--) {
        const HitData before = nearest[place - 1];
        if (!precedes(&hit, &before))
            break;
        if (place < lists->room)
            nearest[place] = before;
    }
    if (place < lists->room)
        nearest[place] = hit;
}

// Adds the given lanes' hits that are not beyond `limit`.
static NOT_INLINE void add_crossings(const Tracer *tracer, const Ray *ray, Mask lanes,
                                     const Hit *hit, Real limit)
{
    const uint bits = lane_bits(lanes && hit->t <= limit && hit->t < INFINITY);
    for (uint lane = 0; lane < CLRT_LANES; lane++)
        if ((bits >> lane & 1) != 0)
            add_crossing(
                &tracer->tally->lists, ((const uint *)&ray->number)[lane],
                (HitData){(float)((const Scalar *)&hit->t)[lane], ((const uint *)&hit->id)[lane]});
}

#else

static inline void add_crossings(const Tracer *tracer, const Ray *ray, Mask lanes, const Hit *hit,
                                 Real limit)
{
    (void)tracer, (void)ray, (void)lanes, (void)hit, (void)limit;
}

#endif
#endif
