// SPDX-License-Identifier: MIT
// Ray against sphere in two-float arithmetic: values as unevaluated sums high + low of 48 bits.
// Single floats lose the discriminant of far, small and huge spheres to cancellation (a ground
// sphere of radius 1e7 is 18 % wrong); this keeps it without fp64.  Roots after Haines, Guenther
// and Akenine-Moeller, Ray Tracing Gems ch. 7; sums and products after Knuth and Dekker.
#ifndef CLRT_SPHERE_CL
#define CLRT_SPHERE_CL
#include "numeric.cl"

typedef struct {
    float high, low;
} TwoFloat;

static inline TwoFloat two_sum(float a, float b)
{
    const float sum = a + b;
    const float part = sum - a;
    return (TwoFloat){sum, (a - (sum - part)) + (b - part)};
}

// The same where |a| >= |b|.
static inline TwoFloat two_sum_ordered(float a, float b)
{
    const float sum = a + b;
    return (TwoFloat){sum, b - (sum - a)};
}

static inline TwoFloat two_add(TwoFloat a, TwoFloat b)
{
    const TwoFloat high = two_sum(a.high, b.high);
    const TwoFloat low = two_sum(a.low, b.low);
    const TwoFloat sum = two_sum_ordered(high.high, high.low + low.high);
    return two_sum_ordered(sum.high, sum.low + low.low);
}

static inline TwoFloat two_negate(TwoFloat a)
{
    return (TwoFloat){-a.high, -a.low};
}

static inline TwoFloat two_scale(TwoFloat a, float b)
{
    const float product = a.high * b;
    const float error = fma(a.high, b, -product);
    return two_sum_ordered(product, fma(a.low, b, error));
}

static inline TwoFloat two_square(TwoFloat a)
{
    const float product = a.high * a.high;
    const float error = fma(a.high, a.high, -product);
    return two_sum_ordered(product, fma(2.0f * a.high, a.low, error));
}

typedef struct {
    TwoFloat x, y, z;
} TwoFloat3;

static inline TwoFloat two_length_squared(TwoFloat3 v)
{
    return two_add(two_add(two_square(v.x), two_square(v.y)), two_square(v.z));
}

static inline TwoFloat two_dot(TwoFloat3 v, float3 d)
{
    return two_add(two_add(two_scale(v.x, d.x), two_scale(v.y, d.y)), two_scale(v.z, d.z));
}

static inline TwoFloat two_from_center(float origin, float center, float center_low)
{
    const TwoFloat difference = two_sum(origin, -center);
    return two_sum_ordered(difference.high, difference.low - center_low);
}

static inline TwoFloat sphere_center(global const SphereData *sphere, uint axis)
{
    return (TwoFloat){sphere->center[axis], sphere->center_low[axis]};
}

static inline TwoFloat3 sphere_to_origin(global const SphereData *sphere, float3 origin)
{
    return (TwoFloat3){two_from_center(origin.x, sphere->center[0], sphere->center_low[0]),
                       two_from_center(origin.y, sphere->center[1], sphere->center_low[1]),
                       two_from_center(origin.z, sphere->center[2], sphere->center_low[2])};
}

// The discriminant over |d|^2: radius^2 minus the squared distance of the center to the line.
// s only needs to be near the foot of the perpendicular: the last term takes out what it is off.
static inline float sphere_discriminant(TwoFloat3 f, float3 d, float s, float dd, TwoFloat rr)
{
    const TwoFloat3 foot = {two_add(f.x, two_scale((TwoFloat){s, 0.0f}, d.x)),
                            two_add(f.y, two_scale((TwoFloat){s, 0.0f}, d.y)),
                            two_add(f.z, two_scale((TwoFloat){s, 0.0f}, d.z))};
    const float along = two_dot(foot, d).high;
    return two_add(rr, two_negate(two_length_squared(foot))).high + along * along / dd;
}

// Whether plain floats already prove that the line passes the sphere by.  Their error is below 16
// units of rounding of the squares of all lengths involved, of which 64 are allowed.  It spares
// most spheres the exact test: three of them took half the time of a picture without it.
static inline bool sphere_is_passed(global const SphereData *sphere, float3 origin, float3 d)
{
    const float3 center = load3(sphere->center);
    const float3 f = origin - center;
    const float3 foot = f - (dot_product(f, d) / dot_product(d, d)) * d;
    const float rr = sphere->radius * sphere->radius;
    const float apart = dot_product(foot, foot) - rr;
    const float squares = dot_product(origin, origin) + dot_product(center, center) + rr;
    return apart > 64.0f * UNIT_ROUNDOFF * squares;
}

// The smallest distance t > 0 at which origin + t * direction meets the sphere, INFINITY where it
// does not.  A ray inside meets the far wall.
static inline float sphere_distance(global const SphereData *sphere, float3 origin, float3 d)
{
    if (sphere_is_passed(sphere, origin, d))
        return INFINITY;
    const TwoFloat3 f = sphere_to_origin(sphere, origin);
    const TwoFloat rr = two_square((TwoFloat){sphere->radius, sphere->radius_low});
    const float dd = dot_product(d, d);
    const float b = -two_dot(f, d).high;
    const float discriminant = sphere_discriminant(f, d, b / dd, dd, rr);
    if (!(discriminant >= 0.0f))
        return INFINITY;
    const float q = b + copysign(sqrt(dd * discriminant), b);
    const float c = two_add(two_length_squared(f), two_negate(rr)).high;
    const float one = c / q, other = q / dd;
    const float near = one < other ? one : other;
    const float far = one < other ? other : one;
    return near > 0.0f ? near : far > 0.0f ? far : INFINITY;
}

// Where the ray that meets the sphere at t does so.  The point on the ray is pulled onto the
// sphere, so that its error is that of rounding it, whatever the radius.
static inline float3 sphere_point(global const SphereData *sphere, float3 origin, float3 d, float t,
                                  float3 *normal)
{
    const TwoFloat3 f = sphere_to_origin(sphere, origin);
    const TwoFloat step = {t, 0.0f};
    const TwoFloat3 q = {two_add(f.x, two_scale(step, d.x)), two_add(f.y, two_scale(step, d.y)),
                         two_add(f.z, two_scale(step, d.z))};
    const TwoFloat rr = two_square((TwoFloat){sphere->radius, sphere->radius_low});
    const float inside = two_add(rr, two_negate(two_length_squared(q))).high;
    const float pull = 0.5f * inside / sphere->radius;
    const float3 n = unit_vector((float3)(q.x.high, q.y.high, q.z.high));
    *normal = n;
    return (
        float3)(two_add(two_add(q.x, (TwoFloat){pull * n.x, 0.0f}), sphere_center(sphere, 0)).high,
                two_add(two_add(q.y, (TwoFloat){pull * n.y, 0.0f}), sphere_center(sphere, 1)).high,
                two_add(two_add(q.z, (TwoFloat){pull * n.z, 0.0f}), sphere_center(sphere, 2)).high);
}

// sphere_distance for a ray that starts on this sphere: its near root is zero by construction, and
// the chord to the far wall is kept where it is longer than the origin's own error.
static inline float sphere_chord(global const SphereData *sphere, float3 origin, float3 d)
{
    const float b = -two_dot(sphere_to_origin(sphere, origin), d).high;
    const float t = 2.0f * b / dot_product(d, d);
    return t > 0x1p-17f * sphere->radius ? t : INFINITY;
}

#endif
