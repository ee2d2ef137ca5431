// SPDX-License-Identifier: MIT
// Intersects rays and spheres in two-float arithmetic. A value is an unevaluated sum high + low of
// 48 bits (106 if Real is double). In single floats, the discriminant of far, small and huge
// spheres would be lost to cancellation. The distance to a ground sphere of radius 1e7, from a
// height of 1, would be off by 16 %. Two-float arithmetic avoids this without fp64.
//
// The roots follow Haines, Guenther and Akenine-Moeller (Ray Tracing Gems, chapter 7). The sums and
// products follow Knuth and Dekker.
#ifndef CLRT_SPHERE_CL
#define CLRT_SPHERE_CL
#include "numeric.cl"

typedef struct {
    Real high, low;
} TwoFloat;

// Returns the rounded sum and its error. With AVX-512, the operands are first sorted by magnitude,
// which makes the chain of operations shorter. Both versions are exact, and return +0 for an error
// of zero.
static inline TwoFloat two_sum(Real a, Real b)
{
    const Real sum = a + b;
#if CLRT_LANES == 16 && defined(__AVX512DQ__) && __has_builtin(__builtin_ia32_rangeps512_mask)
    typedef float Register __attribute__((vector_size(64)));
    const Register c = (Register)a, d = (Register)b;
    const Register less = __builtin_ia32_rangeps512_mask(c, d, 6, c, (ushort)ALL_LANES, 4);
    const Register more = __builtin_ia32_rangeps512_mask(c, d, 7, c, (ushort)ALL_LANES, 4);
    return (TwoFloat){sum, (as_float16(more) - sum) + as_float16(less)};
#else
    const Real part = sum - a;
    return (TwoFloat){sum, (a - (sum - part)) + (b - part)};
#endif
}

// Returns two_sum(a, b) in fewer operations. Requires |a| >= |b|.
static inline TwoFloat two_sum_ordered(Real a, Real b)
{
    const Real sum = a + b;
    return (TwoFloat){sum, b - (sum - a)};
}

// Returns a number that the scene stores as two floats. In fp64, their sum fits into one double.
static inline TwoFloat two_stored(Real high, Real low)
{
    return CLRT_FP64 ? two_sum_ordered(high, low) : (TwoFloat){high, low};
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

static inline TwoFloat two_scale(TwoFloat a, Real b)
{
    const Real product = a.high * b;
    const Real error = fma(a.high, b, -product);
    return two_sum_ordered(product, fma(a.low, b, error));
}

static inline TwoFloat two_square(TwoFloat a)
{
    const Real product = a.high * a.high;
    const Real error = fma(a.high, a.high, -product);
    return two_sum_ordered(product, fma(2.0f * a.high, a.low, error));
}

static inline TwoFloat two_multiply(TwoFloat a, TwoFloat b)
{
    const Real product = a.high * b.high;
    const Real error = fma(a.high, b.high, -product);
    return two_sum_ordered(product, fma(a.high, b.low, fma(a.low, b.high, error)));
}

static inline TwoFloat two_magnitude(TwoFloat a)
{
    return (TwoFloat){fabs(a.high), a.high < 0.0f ? -a.low : a.low};
}

static inline TwoFloat two_choose(Mask first, TwoFloat a, TwoFloat b)
{
    return (TwoFloat){first ? a.high : b.high, first ? a.low : b.low};
}

typedef struct {
    TwoFloat x, y, z;
} TwoFloat3;

static inline TwoFloat two_length_squared(TwoFloat3 v)
{
    return two_add(two_add(two_square(v.x), two_square(v.y)), two_square(v.z));
}

static inline TwoFloat two_dot(TwoFloat3 v, Real3 d)
{
    return two_add(two_add(two_scale(v.x, d.x), two_scale(v.y, d.y)), two_scale(v.z, d.z));
}

typedef struct {
    TwoFloat3 center;
    TwoFloat radius;
} Sphere;

// Returns the same sphere in all lanes.
static inline Sphere sphere_at(global const SphereData *data)
{
    return (Sphere){{two_stored(data->center[0], data->center_low[0]),
                     two_stored(data->center[1], data->center_low[1]),
                     two_stored(data->center[2], data->center_low[2])},
                    two_stored(data->radius, data->radius_low)};
}

static inline TwoFloat two_from_center(Real origin, TwoFloat center)
{
    const TwoFloat difference = two_sum(origin, -center.high);
    return two_sum_ordered(difference.high, difference.low - center.low);
}

static inline TwoFloat3 sphere_to_origin(const Sphere *sphere, Real3 origin)
{
    return (TwoFloat3){two_from_center(origin.x, sphere->center.x),
                       two_from_center(origin.y, sphere->center.y),
                       two_from_center(origin.z, sphere->center.z)};
}

// Returns f + step * d.
static inline TwoFloat3 two_stepped(TwoFloat3 f, Real step, Real3 d)
{
    const TwoFloat s = {step, 0.0f};
    return (TwoFloat3){two_add(f.x, two_scale(s, d.x)), two_add(f.y, two_scale(s, d.y)),
                       two_add(f.z, two_scale(s, d.z))};
}

// Returns radius^2 minus the squared distance between the center and the line. Its sign is that of
// the quadratic equation's discriminant. `s` only needs to be near the foot of the perpendicular,
// because the last term corrects the error of `s`.
static inline Real sphere_discriminant(TwoFloat3 f, Real3 d, Real s, Real dd, TwoFloat rr)
{
    const TwoFloat3 foot = two_stepped(f, s, d);
    const Real along = two_dot(foot, d).high;
    return two_add(rr, two_negate(two_length_squared(foot))).high + along * along / dd;
}

// Returns |f|^2 - radius^2, which is the product of the origin's distances to both walls along the
// line through the center. If the origin is at height 1 over a sphere of radius 1e9, squares of 48
// bits would move the hit by 6e-6. For the largest component z of f, the sum therefore contains
// (z - radius) (z + radius) instead of z^2 - radius^2.
static inline Real sphere_power(TwoFloat3 f, TwoFloat radius)
{
    const Mask z_first = fabs(f.z.high) >= max(fabs(f.x.high), fabs(f.y.high));
    const Mask y_first = !z_first && fabs(f.y.high) >= fabs(f.x.high);
    const TwoFloat x = two_choose(z_first || y_first, f.x, f.z);
    const TwoFloat y = two_choose(y_first, f.z, f.y);
    const TwoFloat z = two_magnitude(two_choose(z_first, f.z, two_choose(y_first, f.y, f.x)));
    const TwoFloat beyond = two_multiply(two_add(z, two_negate(radius)), two_add(z, radius));
    return two_add(two_add(two_square(x), two_square(y)), beyond).high;
}

static inline Real3 plain_center(const Sphere *sphere)
{
    return real3_of(sphere->center.x.high, sphere->center.y.high, sphere->center.z.high);
}

// Returns the squared distance between the center and the line minus radius^2, in plain Reals.
// Stores 64u times the sum of all squared lengths in *doubt. The error is at most 16u times this
// sum (B15).
static inline Real plain_apart(const Sphere *sphere, Real3 origin, Real3 d, Real *doubt)
{
    const Real3 center = plain_center(sphere);
    const Real3 f = difference(origin, center);
    const Real3 foot = difference(f, scaled3(dot_product(f, d) / dot_product(d, d), d));
    const Real rr = sphere->radius.high * sphere->radius.high;
    const Real squares = dot_product(origin, origin) + dot_product(center, center) + rr;
    *doubt = 64.0f * UNIT_ROUNDOFF * squares;
    return dot_product(foot, foot) - rr;
}

// Returns whether plain Reals prove that the line misses the sphere. Most spheres then need no
// two-float test. In a scene with three spheres, two-float tests for all rays would take half of
// the rendering time.
static inline Mask sphere_is_passed(const Sphere *sphere, Real3 origin, Real3 d)
{
    Real doubt;
    const Real apart = plain_apart(sphere, origin, d, &doubt);
    return apart > doubt;
}

// If plain Reals prove that the ray hits the sphere, returns an upper bound on the result of
// exact_sphere_distance. Otherwise, returns INFINITY. The bound is the distance to the foot of the
// perpendicular plus 1.05 times the radius (B23).
static inline Real certain_reach(const Sphere *sphere, Real3 origin, Real3 d)
{
    Real doubt;
    const Real apart = plain_apart(sphere, origin, d, &doubt), dd = dot_product(d, d);
    const Real along = dot_product(difference(origin, plain_center(sphere)), d);
    const Mask precise = dd > 0x1p-100f && dd < 0x1p100f && apart < -0x1p-80f;
    const Mask is_hit = precise && apart < -doubt && along < 0.0f;
    return is_hit ? 1.05f * sphere->radius.high / sqrt(dd) - along / dd : INFINITY;
}

// Returns whether plain Reals prove that the ray leads away from the sphere's center. The error of
// `along` is at most 8u times the root of squares * |d|^2 (B15), and the test allows 32u. The first
// comparison excludes numbers whose squares could underflow.
static inline Mask leads_away(const Sphere *sphere, Real3 origin, Real3 d)
{
    const Real3 center = plain_center(sphere);
    const Real along = dot_product(difference(origin, center), d);
    const Real squares = dot_product(origin, origin) + dot_product(center, center);
    const Real doubt = 1024.0f * UNIT_ROUNDOFF * UNIT_ROUNDOFF * squares * dot_product(d, d);
    return along > 0x1p-40f && along * along > doubt;
}

// Returns 1 if plain Reals prove that the origin is outside the sphere, -1 if they prove that it is
// inside, and else 0. The error is at most 16u times the squares (B15), and the test allows 64u.
static inline Mask plain_side(const Sphere *sphere, Real3 origin)
{
    const Real3 center = plain_center(sphere), f = difference(origin, center);
    const Real rr = sphere->radius.high * sphere->radius.high;
    const Real power = dot_product(f, f) - rr;
    const Real squares = dot_product(origin, origin) + dot_product(center, center) + rr;
    const Real doubt = 64.0f * UNIT_ROUNDOFF * squares;
    const Mask inside = power < -doubt ? (Mask)(-1) : (Mask)(0);
    return power > doubt ? (Mask)(1) : inside;
}

// Returns the lanes of `wanted`, except lanes in which plain Reals prove that the ray meets no
// sphere in the bounding sphere before `t` (B21).
static inline Mask may_meet_before(const Sphere *bound, Real3 origin, Real3 d, Real t, Mask wanted)
{
    const Mask leaves = leads_away(bound, origin, d) && plain_side(bound, origin) > 0;
    const Mask is_near = wanted && !sphere_is_passed(bound, origin, d) && !leaves;
    const Real3 center = plain_center(bound), f = difference(center, origin);
    const Real dd = dot_product(d, d), ahead = dot_product(f, d) - t * dd;
    const Real rr = bound->radius.high * bound->radius.high;
    const Real squares = dot_product(origin, origin) + dot_product(center, center) + rr;
    const Real reach = rr + 256.0f * UNIT_ROUNDOFF * (squares + t * t * dd);
    return is_near && !(ahead > 0.0f && ahead * ahead > 1.01f * reach * dd);
}

// The distances at which a ray's line enters and leaves a sphere, or INFINITY if it misses.
typedef struct {
    Real near, far;
} SphereWalls;

static inline SphereWalls exact_sphere_walls(const Sphere *sphere, Real3 origin, Real3 d)
{
    const TwoFloat3 f = sphere_to_origin(sphere, origin);
    const TwoFloat rr = two_square(sphere->radius);
    const Real dd = dot_product(d, d);
    const Real b = -two_dot(f, d).high;
    const Real discriminant = sphere_discriminant(f, d, b / dd, dd, rr);
    const Real q = b + copysign(sqrt(dd * discriminant), b);
    const Real c = sphere_power(f, sphere->radius);
    const Real one = c / q, other = q / dd;
    const Real near = one < other ? one : other;
    const Real far = one < other ? other : one;
    const Mask is_hit = discriminant >= 0.0f;
    return (SphereWalls){is_hit ? near : INFINITY, is_hit ? far : INFINITY};
}

// Returns the smallest t > 0 at which origin + t * direction hits the sphere, and INFINITY if the
// ray misses. A ray from inside hits the far wall.
static inline Real exact_sphere_distance(const Sphere *sphere, Real3 origin, Real3 d)
{
    const SphereWalls walls = exact_sphere_walls(sphere, origin, d);
    const Real first = walls.far > 0.0f ? walls.far : INFINITY;
    return walls.near > 0.0f ? walls.near : first;
}

// Returns the lanes of `wanted`, except lanes in which plain Reals prove that the ray misses.
static inline Mask sphere_is_near(const Sphere *sphere, Real3 origin, Real3 d, Mask wanted)
{
    if (!any_lane(wanted))
        return 0;
    const Mask is_near = wanted && !sphere_is_passed(sphere, origin, d);
    if (!any_lane(is_near))
        return 0;
    return is_near && !(leads_away(sphere, origin, d) && plain_side(sphere, origin) > 0);
}

// Returns exact_sphere_distance in the lanes of `wanted`, and INFINITY in the others.
static inline Real sphere_distance(const Sphere *sphere, Real3 origin, Real3 d, Mask wanted)
{
    const Mask is_near = sphere_is_near(sphere, origin, d, wanted);
    if (!any_lane(is_near))
        return INFINITY;
    const Real t = exact_sphere_distance(sphere, origin, d);
    return is_near ? t : INFINITY;
}

// Returns the hit point at `t`, and stores its unit normal in *normal. The ray's point at `t` is
// projected onto the sphere, so the result's error is one rounding for any radius.
static inline Real3 sphere_point(const Sphere *sphere, Real3 origin, Real3 d, Real t, Real3 *normal)
{
    const TwoFloat3 q = two_stepped(sphere_to_origin(sphere, origin), t, d);
    const TwoFloat rr = two_square(sphere->radius);
    const Real inside = two_add(rr, two_negate(two_length_squared(q))).high;
    const Real pull = 0.5f * inside / sphere->radius.high;
    const Real3 n = unit_vector(real3_of(q.x.high, q.y.high, q.z.high));
    *normal = n;
    const TwoFloat3 on = {two_add(q.x, (TwoFloat){pull * n.x, 0.0f}),
                          two_add(q.y, (TwoFloat){pull * n.y, 0.0f}),
                          two_add(q.z, (TwoFloat){pull * n.z, 0.0f})};
    return real3_of(two_add(on.x, sphere->center.x).high, two_add(on.y, sphere->center.y).high,
                    two_add(on.z, sphere->center.z).high);
}

// Returns the distance to the far wall for a ray that starts on this sphere. The direction's length
// must be about 1. The near root is zero, and the far root is the chord. Returns INFINITY for
// chords up to the origin's error or 128u times the radius, whichever is larger.
static inline Real sphere_chord(const Sphere *sphere, Real3 origin, Real3 d)
{
    const Real b = -two_dot(sphere_to_origin(sphere, origin), d).high;
    const Real t = 2.0f * b / dot_product(d, d);
    const Real3 size = magnitudes(origin);
    const Real error = 4.0f * UNIT_ROUNDOFF * (size.x + size.y + size.z);
    return t > max(128.0f * UNIT_ROUNDOFF * sphere->radius.high, error) ? t : INFINITY;
}

#endif
