// SPDX-License-Identifier: MIT
// Signed fields of simple shapes, and how to blend them: about the distance to the surface,
// negative inside.  Blends are Quilez's polynomial smooth minimum ("smooth minimum", 2013), which
// changes a field only where the two shapes are within the blend width of each other.
#pragma once

#include "base/vec.h"
#include "wave.h"

// Farther than the blends between a model's parts reach: beyond it, a bound will do for a part.
#define SHAPE_FAR 0.05

static inline double shape_smaller(double a, double b)
{
    return a < b ? a : b;
}

static inline double shape_larger(double a, double b)
{
    return a > b ? a : b;
}

static inline double shape_clamp(double value, double low, double high)
{
    return value < low ? low : value > high ? high : value;
}

// 0 up to low, 1 from high on, a smooth cubic between.
static inline double shape_step(double value, double low, double high)
{
    const double t = shape_clamp((value - low) / (high - low), 0, 1);
    return t * t * (3 - 2 * t);
}

static inline double shape_length(Vec3 a)
{
    return sqrt(vec3_dot(a, a));
}

// The point mirrored onto y >= 0: what is made once appears on both sides.
static inline Vec3 shape_mirror(Vec3 p)
{
    return vec3(p.x, fabs(p.y), p.z);
}

// The point as seen from a frame at center, turned by that much about x, y or z.
static inline Vec3 shape_turn_x(Vec3 p, Vec3 center, double turns)
{
    const double c = wave_cosine(turns), s = wave_sine(turns);
    p = vec3_sub(p, center);
    return vec3(p.x, c * p.y + s * p.z, c * p.z - s * p.y);
}

static inline Vec3 shape_turn_y(Vec3 p, Vec3 center, double turns)
{
    const double c = wave_cosine(turns), s = wave_sine(turns);
    p = vec3_sub(p, center);
    return vec3(c * p.x - s * p.z, p.y, c * p.z + s * p.x);
}

static inline Vec3 shape_turn_z(Vec3 p, Vec3 center, double turns)
{
    const double c = wave_cosine(turns), s = wave_sine(turns);
    p = vec3_sub(p, center);
    return vec3(c * p.x + s * p.y, c * p.y - s * p.x, p.z);
}

// The point turned about the z axis into the sector round +x, of as many as count in the circle,
// and mirrored onto y >= 0: what is made once stands count times in a ring.
static inline Vec3 shape_repeat(Vec3 p, double count)
{
    const double turns = floor(wave_turns(p.y, p.x) * count + 0.5) / count;
    return shape_mirror(shape_turn_z(p, vec3(0, 0, 0), turns));
}

static inline double shape_sphere(Vec3 p, Vec3 center, double radius)
{
    return shape_length(vec3_sub(p, center)) - radius;
}

// The ellipsoid's implicit function over its gradient: the distance to first order.
static inline double shape_ellipsoid(Vec3 p, Vec3 center, Vec3 radii)
{
    const Vec3 d = vec3_sub(p, center);
    const Vec3 once = vec3(d.x / radii.x, d.y / radii.y, d.z / radii.z);
    const Vec3 twice = vec3(once.x / radii.x, once.y / radii.y, once.z / radii.z);
    const double steepness = shape_length(twice);
    if (!(steepness > 0))
        return -shape_smaller(radii.x, shape_smaller(radii.y, radii.z));
    const double reach = shape_length(once);
    return reach * (reach - 1) / steepness;
}

// A ball rolled from a to b while its radius goes from radius_a to radius_b.
static inline double shape_capsule(Vec3 p, Vec3 a, Vec3 b, double radius_a, double radius_b)
{
    const Vec3 along = vec3_sub(b, a), from = vec3_sub(p, a);
    const double t = shape_clamp(vec3_dot(from, along) / vec3_dot(along, along), 0, 1);
    const double radius = radius_a + t * (radius_b - radius_a);
    return shape_length(vec3_sub(from, vec3_scale(along, t))) - radius;
}

// A chain of capsules along a cubic Bezier curve, tapering from its start to its end.
static inline double shape_curve(Vec3 p, const Vec3 control[4], double radius_a, double radius_b)
{
    enum { PIECES = 20 };
    double field = HUGE_VAL, radius = radius_a;
    Vec3 start = control[0];
    for (int piece = 1; piece <= PIECES; piece++) {
        const double t = (double)piece / (double)PIECES, s = 1 - t;
        const Vec3 first =
            vec3_add(vec3_scale(control[0], s * s * s), vec3_scale(control[1], 3 * s * s * t));
        const Vec3 second =
            vec3_add(vec3_scale(control[2], 3 * s * t * t), vec3_scale(control[3], t * t * t));
        const Vec3 end = vec3_add(first, second);
        const double next = radius_a + t * (radius_b - radius_a);
        field = shape_smaller(field, shape_capsule(p, start, end, radius, next));
        start = end;
        radius = next;
    }
    return field;
}

// A ring about the z axis through center: a tube of radius tube round a circle of radius ring.
static inline double shape_torus(Vec3 p, Vec3 center, double ring, double tube)
{
    const Vec3 d = vec3_sub(p, center);
    const double out = sqrt(d.x * d.x + d.y * d.y) - ring;
    return sqrt(out * out + d.z * d.z) - tube;
}

// A tube of that radius along the line where the surfaces of a and b meet.
static inline double shape_seam(double a, double b, double radius)
{
    return sqrt(a * a + b * b) - radius;
}

// Both shapes, with the seam between them filled to that width.
static inline double shape_join(double a, double b, double blend)
{
    const double near = shape_larger(blend - fabs(a - b), 0);
    return shape_smaller(a, b) - near * near / (4 * blend);
}

// The intersection of both, with the edge rounded to that width.
static inline double shape_overlap(double a, double b, double blend)
{
    return -shape_join(-a, -b, blend);
}

// a without b, with the edge rounded to that width.
static inline double shape_cut(double a, double b, double blend)
{
    return shape_overlap(a, -b, blend);
}
