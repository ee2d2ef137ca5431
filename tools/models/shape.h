// SPDX-License-Identifier: MIT
// Signed distance fields of simple shapes, and blends of fields. Values approximate the distance to
// the surface and are negative inside. Blends use Quilez's polynomial smooth minimum ("smooth
// minimum", 2013). It differs from the minimum only where the two fields differ by less than the
// blend width.
#pragma once

#include "base/vec.h"
#include "wave.h"

// Farther than this from a part, a bound of the part's field is sufficient. There, the exact value
// does not matter, because blends are narrower.
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

// Returns 0 up to low, 1 from high on, and a smooth cubic between. low may exceed high.
static inline double shape_step(double value, double low, double high)
{
    const double t = shape_clamp((value - low) / (high - low), 0, 1);
    return t * t * (3 - 2 * t);
}

static inline double shape_length(Vec3 a)
{
    return sqrt(vec3_dot(a, a));
}

// Returns the point mirrored onto y >= 0, so that a shape appears on both sides.
static inline Vec3 shape_mirror(Vec3 p)
{
    return vec3(p.x, fabs(p.y), p.z);
}

// These functions return the point in the coordinates of a frame. The frame is centered at `center`
// and rotated by `turns` about x, y or z.
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

// Returns the point rotated about the z axis into the sector around +x, and mirrored onto y >= 0.
// The circle has count sectors, so a shape appears count times in a ring.
static inline Vec3 shape_repeat(Vec3 p, double count)
{
    const double turns = floor(wave_turns(p.y, p.x) * count + 0.5) / count;
    return shape_mirror(shape_turn_z(p, vec3(0, 0, 0), turns));
}

static inline double shape_sphere(Vec3 p, Vec3 center, double radius)
{
    return shape_length(vec3_sub(p, center)) - radius;
}

// Returns the ellipsoid's implicit function divided by the length of its gradient. The quotient is
// the distance to first order.
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

// The region swept by a ball that moves from a to b while its radius changes from radius_a to
// radius_b.
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

// A torus around an axis through center, parallel to z: a tube of radius tube around a circle of
// radius ring.
static inline double shape_torus(Vec3 p, Vec3 center, double ring, double tube)
{
    const Vec3 d = vec3_sub(p, center);
    const double out = sqrt(d.x * d.x + d.y * d.y) - ring;
    return sqrt(out * out + d.z * d.z) - tube;
}

// A tube of this radius along the line where the surfaces of a and b intersect.
static inline double shape_seam(double a, double b, double radius)
{
    return sqrt(a * a + b * b) - radius;
}

// The union of two shapes. The groove between the shapes is filled up to the width `blend`.
static inline double shape_join(double a, double b, double blend)
{
    const double near = shape_larger(blend - fabs(a - b), 0);
    return shape_smaller(a, b) - near * near / (4 * blend);
}

// The intersection of two shapes, with the edge rounded to this width.
static inline double shape_overlap(double a, double b, double blend)
{
    return -shape_join(-a, -b, blend);
}

// a without b, with the edge rounded to this width.
static inline double shape_cut(double a, double b, double blend)
{
    return shape_overlap(a, -b, blend);
}
