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
    Mask triangle; // RTC_INVALID_GEOMETRY_ID: no hit
    Mask geometry, instance;
} RayHits;

#if LANES == 16
_Static_assert(sizeof(RayHits) == sizeof(struct RTCRayHit16), "a packet is not Embree's");
#elif LANES == 8
_Static_assert(sizeof(RayHits) == sizeof(struct RTCRayHit8), "a packet is not Embree's");
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
#endif

static inline void call_intersect(RTCScene scene, struct RTCIntersectContext *context,
                                  const Mask valid[PACKETS], RayHits hits[PACKETS])
{
#if PACKETS > 1
    for (int packet = 0; packet < PACKETS; packet++)
        leave_out(&hits[packet].rays, valid[packet]);
    rtcIntersectNM(scene, context, (struct RTCRayHitN *)hits, LANES, PACKETS, sizeof *hits);
#elif LANES == 16
    rtcIntersect16((const int *)valid, scene, context, (struct RTCRayHit16 *)hits);
#elif LANES == 8
    rtcIntersect8((const int *)valid, scene, context, (struct RTCRayHit8 *)hits);
#else
    (void)valid;
    rtcIntersect1(scene, context, (struct RTCRayHit *)hits);
#endif
}

// Sets far to -INFINITY for occluded rays.
static inline void call_occluded(RTCScene scene, struct RTCIntersectContext *context,
                                 const Mask valid[PACKETS], Rays rays[PACKETS])
{
#if PACKETS > 1
    for (int packet = 0; packet < PACKETS; packet++)
        leave_out(&rays[packet], valid[packet]);
    rtcOccludedNM(scene, context, (struct RTCRayN *)rays, LANES, PACKETS, sizeof *rays);
#elif LANES == 16
    rtcOccluded16((const int *)valid, scene, context, (struct RTCRay16 *)rays);
#elif LANES == 8
    rtcOccluded8((const int *)valid, scene, context, (struct RTCRay8 *)rays);
#else
    (void)valid;
    rtcOccluded1(scene, context, (struct RTCRay *)rays);
#endif
}
