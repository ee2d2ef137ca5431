// SPDX-License-Identifier: MIT
// A thick ray against a sphere.  sphere.cl computes with sums of two floats: for roundoff u, its
// error of the discriminant radius^2 - distance^2 is below 2^6 u^2 (distance + radius) (|f| +
// radius + |center|), f from the center to the origin, and below 64 u^3 |f|^2 for the foot of the
// perpendicular.  Either is less than moving the ray aside by `distance_doubt` does, and so is the
// error of the product of the distances; what else goes into a distance is right to 8u of its size.
#ifndef CLRT_SURE_SPHERE_CL
#define CLRT_SURE_SPHERE_CL
#include "sure_triangle.cl"

typedef struct {
    Real3 center;
    Real radius;
} PlainSphere;

// The stored sums have 48 bits, which one double holds.
static inline PlainSphere plain_sphere(global const SphereData *data)
{
    const Sphere sphere = sphere_at(data);
    return (PlainSphere){
        real3_of(sphere.center.x.high, sphere.center.y.high, sphere.center.z.high),
        sphere.radius.high};
}

// What this program's own arithmetic loses of a distance is 2^-49 of the same sum.
static inline Real distance_doubt(Real u, Real apart, const PlainSphere *sphere)
{
    const Real sizes = apart + sphere->radius + length_of(sphere->center);
    return max(0x1p8f * u * u, (Real)(0x1p-48f)) * sizes +
           0x1p8f * u * u * u * apart * apart / sphere->radius;
}

// The depths at which a line enters and leaves the sphere, each between low and high.
typedef struct {
    Answer met; // of the line
    Real enter_low, enter_high, leave_low, leave_high;
    Real aside; // how far elsewhere the line may lie
} Chord;

static inline Chord chord_of(const ThickRay *ray, const PlainSphere *sphere)
{
    const Real3 f = difference(sphere->center, ray->origin);
    const Real middle = dot_product(f, ray->along);
    const Real distance = length_of(difference(f, scaled3(middle, ray->along)));
    const Real apart = fabs(middle) + distance, r = sphere->radius;
    const Real doubt = distance_doubt(ray->u, apart, sphere);
    const Real aside = 1.01f * (ray->around + ray->spread * (apart + r + ray->around) + doubt);
    const Real least = max(distance - aside, (Real)(0.0f)), most = distance + aside;
    Chord chord = {.met = ANSWER_NO, .aside = aside};
    if (least > r)
        return chord;
    chord.met = most < r ? ANSWER_YES : ANSWER_UNKNOWN;
    const Real longest = sqrt((r - least) * (r + least));
    const Real shortest = most < r ? sqrt((r - most) * (r + most)) : 0.0f;
    const Real along = 2.0f * aside + 16.0f * (ray->u + OWN_ROUNDOFF) * (apart + longest);
    chord.enter_low = middle - longest - along;
    chord.enter_high = middle - shortest + along;
    chord.leave_low = middle + shortest - along;
    chord.leave_high = middle + longest + along;
    return chord;
}

// A ray that starts inside meets the far wall.
static inline Candidate sphere_candidate(const Chord *chord)
{
    if (chord->met == ANSWER_NO || chord->leave_high < 0.0f)
        return candidate_none();
    if (chord->met == ANSWER_YES && chord->enter_low > 0.0f)
        return (Candidate){ANSWER_YES, chord->enter_low, chord->enter_high};
    if (chord->met == ANSWER_YES && chord->enter_high < 0.0f && chord->leave_low > 0.0f)
        return (Candidate){ANSWER_YES, chord->leave_low, chord->leave_high};
    return (Candidate){ANSWER_UNKNOWN, max(chord->enter_low, (Real)(0.0f)), chord->leave_high};
}

// Whether a wall stands between the ray's start and its end, within [least, most].
static inline Answer sphere_blocks(const Chord *chord, Real least, Real most)
{
    if (chord->met == ANSWER_NO || chord->leave_high < 0.0f || chord->enter_low > most)
        return ANSWER_NO;
    if (chord->met == ANSWER_UNKNOWN)
        return ANSWER_UNKNOWN;
    if (chord->enter_high < 0.0f && chord->leave_low > most)
        return ANSWER_NO;
    const bool enters = chord->enter_low > 0.0f && chord->enter_high < least;
    const bool leaves = chord->enter_high < 0.0f && chord->leave_low > 0.0f &&
                        chord->leave_high < least;
    return enters || leaves ? ANSWER_YES : ANSWER_UNKNOWN;
}

// The sphere that the ray starts on is met again from inside, where its chord is longer than what
// sphere_chord asks for.
static inline Candidate own_sphere_candidate(const ThickRay *ray, const PlainSphere *sphere)
{
    const Real3 f = difference(sphere->center, ray->origin);
    const Real middle = dot_product(f, ray->along), r = sphere->radius;
    const Real doubt = 1.1f * (ray->around + ray->spread * (r + ray->around)) +
                       distance_doubt(ray->u, r, sphere) + 16.0f * ray->u * fabs(middle);
    const Real least = ray->u * max(64.0f * r, 2.0f * sum_of_sizes(ray->origin));
    if (middle < -doubt)
        return candidate_none();
    const bool is_sure = middle - doubt > 1.1f * least;
    return (Candidate){is_sure ? ANSWER_YES : ANSWER_UNKNOWN, is_sure ? 2.0f * (middle - doubt) : 0.0f,
                       2.0f * (middle + doubt)};
}

#endif
