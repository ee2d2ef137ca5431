// SPDX-License-Identifier: MIT
// Decides whether a ray cone hits a sphere, and at which depths.
//
// sphere.cl represents each number by the sum of two floats. Let f lead from the sphere's center to
// the ray's origin, let h be the center's distance from the ray's line, and let u be the unit
// roundoff. The error of the discriminant radius^2 - h^2 is below 64 u^2 (h + radius) (|f| + radius
// + |center|). The error of the foot of the perpendicular adds less than 64 u^3 |f|^2. Moving the
// ray aside by distance_doubt changes the discriminant by more than both errors, so bounds for the
// moved ray cover them. The move also changes |f|^2 - radius^2 by more than the error of
// sphere_power. All other terms of t have a relative error below 8u (B15).
#ifndef CLRT_CERTIFY_SPHERE_CL
#define CLRT_CERTIFY_SPHERE_CL
#include "certify_triangle.cl"

typedef struct {
    Real3 center;
    Real radius;
} PlainSphere;

// Returns the sphere in doubles. The stored sums have 48 bits, which fit into one double.
static inline PlainSphere plain_sphere(global const SphereData *data)
{
    const Sphere sphere = sphere_at(data);
    return (PlainSphere){real3_of(sphere.center.x.high, sphere.center.y.high, sphere.center.z.high),
                         sphere.radius.high};
}

// Returns a bound on the part of the tracer's error that does not grow for small spheres. The error
// of this kernel's own fp64 arithmetic is at most 2^-49 times `sizes`.
static inline Real sizes_doubt(Real u, Real apart, const PlainSphere *sphere)
{
    const Real sizes = apart + sphere->radius + length_of(sphere->center);
    return max(0x1p8f * u * u, (Real)(0x1p-48f)) * sizes;
}

// Returns a bound on the tracer's error, as a distance by which the ray moves aside (see the top of
// this file).
static inline Real distance_doubt(Real u, Real apart, const PlainSphere *sphere)
{
    return sizes_doubt(u, apart, sphere) + 0x1p8f * u * u * u * apart * apart / sphere->radius;
}

typedef struct {
    Real low, high;
} Range;

// The depths at which a line enters and leaves the sphere.
typedef struct {
    Answer met; // whether the line hits the sphere
    Range enter, leave;
    Real shift; // bound on the shift of ray origins, from `around` and the tracer's rounding
} Chord;

// Returns `power` / `sum`. `sum` must be above zero.
static inline Range quotient(Range power, Range sum)
{
    return (Range){power.low / (power.low > 0.0f ? sum.high : sum.low),
                   power.high / (power.high > 0.0f ? sum.low : sum.high)};
}

static inline Range negative_range(Range range)
{
    return (Range){-range.high, -range.low};
}

static inline Range rounded_range(const RayCone *ray, Range range, Real shift)
{
    const Real factor = 16.0f * (ray->u + OWN_ROUNDOFF) + ray->spread * ray->spread;
    return (Range){range.low - factor * fabs(range.low) - shift,
                   range.high + factor * fabs(range.high) + shift};
}

// Returns the depths at which the cone's rays enter and leave the sphere. If a line turns by the
// spread, its point closest to the center moves by spread * |middle| across the line, and by spread
// * distance along it.
//
// The depth of the nearer wall is (|f|^2 - radius^2) / (|middle| + half the chord). The numerator
// does not depend on the direction. The tracer uses this quotient too. A nearby wall of a huge
// sphere is therefore as certain as a wall of a small sphere.
static inline Chord chord_of(const RayCone *ray, const PlainSphere *sphere)
{
    const Real3 f = difference(sphere->center, ray->origin);
    const Real middle = dot_product(f, ray->along), r = sphere->radius, apart = length_of(f);
    const Real distance = length_of(difference(f, scaled3(middle, ray->along)));
    const Real shift = 1.01f * (ray->around + distance_doubt(ray->u, apart, sphere));
    const Real bend = 1.01f * ray->spread * ray->spread * apart;
    const Real aside = shift + bend + 1.01f * ray->spread * fabs(middle);
    const Real doubt = shift + bend + 1.01f * ray->spread * distance;
    const Real least = max(distance - aside, (Real)(0.0f)), most = distance + aside;
    Chord chord = {.met = ANSWER_NO, .shift = shift};
    if (least > r)
        return chord;
    chord.met = most < r ? ANSWER_YES : ANSWER_UNKNOWN;
    const Real longest = sqrt((r - least) * (r + least));
    const Real shortest = most < r ? sqrt((r - most) * (r + most)) : 0.0f;
    const Real height = apart - r, bulk = apart + r;
    const Range power = {height * bulk - 2.02f * shift * (apart + shift),
                         height * bulk + 2.02f * shift * (apart + shift)};
    Range enter = {middle - longest - doubt, middle - shortest + doubt};
    Range leave = {middle + shortest - doubt, middle + longest + doubt};
    if (middle > doubt)
        enter = quotient(power, leave);
    else if (middle < -doubt)
        leave = negative_range(quotient(power, negative_range(enter)));
    chord.enter = rounded_range(ray, enter, shift);
    chord.leave = rounded_range(ray, leave, shift);
    return chord;
}

// Returns the sphere as a candidate for the first hit. A ray that starts inside hits the far wall.
static inline Candidate sphere_candidate(const Chord *chord)
{
    if (chord->met == ANSWER_NO || chord->leave.high < 0.0f)
        return candidate_none();
    if (chord->met == ANSWER_YES && chord->enter.low > 0.0f)
        return (Candidate){ANSWER_YES, chord->enter.low, chord->enter.high};
    if (chord->met == ANSWER_YES && chord->enter.high < 0.0f && chord->leave.low > 0.0f)
        return (Candidate){ANSWER_YES, chord->leave.low, chord->leave.high};
    return (Candidate){ANSWER_UNKNOWN, max(chord->enter.low, (Real)(0.0f)), chord->leave.high};
}

// A ray hits its own sphere again from inside if the chord is longer than sphere_chord requires.
static inline Candidate own_sphere_candidate(const RayCone *ray, const PlainSphere *sphere)
{
    const Real3 f = difference(sphere->center, ray->origin);
    const Real middle = dot_product(f, ray->along), r = sphere->radius;
    const Real doubt = 1.1f * (ray->around + ray->spread * (r + ray->around)) +
                       distance_doubt(ray->u, r, sphere) + 16.0f * ray->u * fabs(middle);
    const Real least = ray->u * max(64.0f * r, 2.0f * sum_of_sizes(ray->origin));
    if (middle < -doubt)
        return candidate_none();
    const bool is_sure = middle - doubt > 1.1f * least;
    return (Candidate){is_sure ? ANSWER_YES : ANSWER_UNKNOWN,
                       is_sure ? 2.0f * (middle - doubt) : 0.0f, 2.0f * (middle + doubt)};
}

// Returns the sphere as a candidate that blocks a shadow ray.
static inline Candidate sphere_blocker(const RayCone *ray, const PlainSphere *sphere, bool is_own)
{
    const Real margin = ray->around + 20.0f * (ray->u + OWN_ROUNDOFF) * ray->length;
    const Chord chord = chord_of(ray, sphere);
    Candidate candidate = is_own ? own_sphere_candidate(ray, sphere) : sphere_candidate(&chord);
    if (candidate.low > ray->length + margin)
        return candidate_none();
    if (candidate.met == ANSWER_YES && !(candidate.high < ray->length - margin))
        candidate.met = ANSWER_UNKNOWN;
    return candidate;
}

#endif
