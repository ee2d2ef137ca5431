// SPDX-License-Identifier: MIT
// Packets of LANES rays, and the calls that trace PACKETS packets. The packets have the layout of
// Embree's own structs, so that Embree traces them in place.
#pragma once

#include "lanes.h"

#include <embree3/rtcore.h>

typedef struct {
    Points origin;
    Floats near;
    Points direction;
    Floats time, far;
    Mask mask, id, flags;
} Rays;

typedef struct {
    Rays rays;
    Points normal; // of any length
    Floats u, v;
    Mask primitive;
    Mask geometry; // RTC_INVALID_GEOMETRY_ID: no hit
    Mask instance;
} RayHits;

#if LANES == 16
_Static_assert(sizeof(RayHits) == sizeof(struct RTCRayHit16), "a packet is not Embree's");
#elif LANES == 8
_Static_assert(sizeof(RayHits) == sizeof(struct RTCRayHit8), "a packet is not Embree's");
#elif LANES == 4
_Static_assert(sizeof(RayHits) == sizeof(struct RTCRayHit4), "a packet is not Embree's");
#elif LANES == 1
_Static_assert(sizeof(RayHits) == sizeof(struct RTCRayHit), "a ray is not Embree's");
#endif

#if PACKETS > 1
// Embree's streams have no mask. They skip rays with an empty interval.
static inline void leave_out(Rays *rays, Mask valid)
{
    rays->near = choose(valid, rays->near, all(INFINITY));
    rays->far = choose(valid, rays->far, all(-INFINITY));
}
#elif LANES == 16 && !defined(__AVX512F__)
// Without AVX-512, Embree splits packets of 16 into two of 8. Debian's Embree 3.13 then asserts
// that even masked rays have finite numbers.
static inline void leave_out(Rays *rays, Mask valid)
{
    rays->origin = points_choose(valid, rays->origin, (Points){0});
    rays->direction = points_choose(valid, rays->direction, (Points){0});
    rays->far = choose(valid, rays->far, all(0));
}
#else
static inline void leave_out(Rays *rays, Mask valid)
{
    (void)rays, (void)valid;
}
#endif

static inline void call_intersect(RTCScene scene, struct RTCIntersectContext *context,
                                  const Mask valid[PACKETS], RayHits hits[PACKETS])
{
    for (int packet = 0; packet < PACKETS; packet++)
        leave_out(&hits[packet].rays, valid[packet]);
#if PACKETS > 1
    rtcIntersectNM(scene, context, (struct RTCRayHitN *)hits, LANES, PACKETS, sizeof *hits);
#elif LANES == 16
    rtcIntersect16((const int *)valid, scene, context, (struct RTCRayHit16 *)hits);
#elif LANES == 8
    rtcIntersect8((const int *)valid, scene, context, (struct RTCRayHit8 *)hits);
#elif LANES == 4
    rtcIntersect4((const int *)valid, scene, context, (struct RTCRayHit4 *)hits);
#else
    rtcIntersect1(scene, context, (struct RTCRayHit *)hits);
#endif
}

// Sets far to -INFINITY for occluded rays.
static inline void call_occluded(RTCScene scene, struct RTCIntersectContext *context,
                                 const Mask valid[PACKETS], Rays rays[PACKETS])
{
    for (int packet = 0; packet < PACKETS; packet++)
        leave_out(&rays[packet], valid[packet]);
#if PACKETS > 1
    rtcOccludedNM(scene, context, (struct RTCRayN *)rays, LANES, PACKETS, sizeof *rays);
#elif LANES == 16
    rtcOccluded16((const int *)valid, scene, context, (struct RTCRay16 *)rays);
#elif LANES == 8
    rtcOccluded8((const int *)valid, scene, context, (struct RTCRay8 *)rays);
#elif LANES == 4
    rtcOccluded4((const int *)valid, scene, context, (struct RTCRay4 *)rays);
#else
    rtcOccluded1(scene, context, (struct RTCRay *)rays);
#endif
}
