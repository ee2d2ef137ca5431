// SPDX-License-Identifier: MIT
// Proves that a point is inside a closed surface: the solid angles of all triangles add up to one
// sphere (Van Oosterom and Strackee, "The solid angle of a plane triangle", 1983).
#include "room.h"

#include "check.h"
#include "shapes.h"

static double length_of(Vec3 v)
{
    return sqrt(vec3_dot(v, v));
}

// Returns the distance from the origin to the segment a b.
static double segment_distance(Vec3 a, Vec3 b)
{
    const Vec3 along = vec3_sub(b, a);
    const double squared = vec3_dot(along, along);
    const double place = squared > 0 ? -vec3_dot(a, along) / squared : 0;
    return length_of(vec3_add(a, vec3_scale(along, fmin(fmax(place, 0), 1))));
}

double distance_to_triangle(const Triangles *triangles, size_t triangle, Vec3 point)
{
    const Vec3 a = vec3_sub(corner_of(triangles, triangle, 0), point);
    const Vec3 b = vec3_sub(corner_of(triangles, triangle, 1), point);
    const Vec3 c = vec3_sub(corner_of(triangles, triangle, 2), point);
    const Vec3 normal = vec3_cross(vec3_sub(b, a), vec3_sub(c, a));
    const double outline =
        fmin(segment_distance(a, b), fmin(segment_distance(b, c), segment_distance(c, a)));
    // True if the foot of the perpendicular is on the inner side of all edges.
    const bool inside = vec3_dot(normal, vec3_cross(a, b)) > 0 &&
                        vec3_dot(normal, vec3_cross(b, c)) > 0 &&
                        vec3_dot(normal, vec3_cross(c, a)) > 0;
    return inside ? fabs(vec3_dot(normal, a)) / length_of(normal) : outline;
}

// Returns the signed solid angle of the triangle from point, as a fraction of the sphere.
static double solid_angle(const Triangles *triangles, size_t triangle, Vec3 point)
{
    const Vec3 a = vec3_normalize(vec3_sub(corner_of(triangles, triangle, 0), point));
    const Vec3 b = vec3_normalize(vec3_sub(corner_of(triangles, triangle, 1), point));
    const Vec3 c = vec3_normalize(vec3_sub(corner_of(triangles, triangle, 2), point));
    const double volume = vec3_dot(a, vec3_cross(b, c));
    const double sum = 1 + vec3_dot(a, b) + vec3_dot(b, c) + vec3_dot(c, a);
    return atan2(volume, sum) / (2 * 3.14159265358979323846);
}

Room room_inside(const Stage *stage, Vec3 center, double half_side)
{
    Room room = {normalize_point(&stage->normalization, center),
                 half_side * stage->normalization.scale, INFINITY, stage->normalization,
                 vec3_extent(center) < 0x1p19 * half_side};
    double winding = 0;
    const Triangles *triangles = &stage->triangles;
    for (size_t i = 0; i < triangles->count; i++) {
        room.radius = fmin(room.radius, 0.999 * distance_to_triangle(triangles, i, room.center));
        winding += solid_angle(triangles, i, room.center);
    }
    assert_true(room.radius > 0);
    assert_true(fabs(fabs(winding) - 1) < 1e-6);
    return room;
}

bool room_contains(const Room *room, Vec3 point)
{
    const Vec3 from_center = vec3_sub(point, room->center);
    return vec3_extent(from_center) <= room->half_side && length_of(from_center) <= room->radius;
}

// Returns the nearest point whose scene coordinates are floats.
static Vec3 float_place(const Normalization *normalization, Vec3 point)
{
    float place[3];
    shape_store(place, denormalize_point(normalization, point));
    return normalize_point(normalization, vec3_of_floats(place));
}

Vec3 room_point(const Room *room, Random *random)
{
    for (;;) {
        Vec3 point = vec3_add(room->center, random_in_cube(random, room->half_side));
        if (room->has_floats)
            point = float_place(&room->normalization, point);
        if (room_contains(room, point))
            return point;
    }
}
