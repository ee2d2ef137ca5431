// SPDX-License-Identifier: MIT
// Random rays find no hole: the tests' rays go to where triangles meet.
#include "aim.h"

#include "check.h"
#include "image/form.h"
#include "shapes.h"

bool aim_moves_origin(size_t i, size_t packet_rays)
{
    return form_choice().family != FAMILY_PACKET || i % packet_rays == 0;
}

TestRay aim_at(Vec3 origin, Vec3 target)
{
    TestRay ray = {.own = NOTHING, .kind = RAY_CAMERA};
    const double from[3] = {origin.x, origin.y, origin.z};
    const double to[3] = {target.x, target.y, target.z};
    for (int axis = 0; axis < 3; axis++) {
        ray.origin[axis] = (float)from[axis];
        ray.direction[axis] = (float)(to[axis] - shape_rounded(from[axis]));
    }
    return ray;
}

void aim_randomly(TestRay *rays, size_t count, const Room *room, Random *random)
{
    Vec3 origin = {0};
    for (size_t i = 0; i < count; i++) {
        if (aim_moves_origin(i, AIM_BUNDLE))
            origin = room_point(room, random);
        rays[i] = aim_at(origin, vec3_add(origin, random_in_cube(random, 1)));
    }
}

Vec3 aim_corner(const Triangles *triangles, size_t triangle, size_t corner)
{
    const float *position = triangles_corner(triangles, triangle, (int)corner);
    return vec3((double)position[0], (double)position[1], (double)position[2]);
}

void aim_at_edges(TestRay *rays, size_t count, const Room *room, const Triangles *triangles,
                  Random *random)
{
    Vec3 origin = {0};
    for (size_t i = 0; i < count; i++) {
        if (aim_moves_origin(i, AIM_BUNDLE))
            origin = room_point(room, random);
        const uint32_t triangle = random_below(random, (uint32_t)triangles->count);
        const uint32_t corner = random_below(random, 3);
        const Vec3 a = aim_corner(triangles, triangle, corner);
        const Vec3 b = aim_corner(triangles, triangle, (corner + 1) % 3);
        const Vec3 along = vec3_scale(vec3_sub(b, a), random_between(random, 0, 1));
        rays[i] = aim_at(origin, vec3_add(a, along));
    }
}

void aim_at_vertices(TestRay *rays, size_t count, const Room *room, const Triangles *triangles,
                     Random *random)
{
    Vec3 origin = {0};
    for (size_t i = 0; i < count; i++) {
        if (aim_moves_origin(i, AIM_BUNDLE))
            origin = room_point(room, random);
        const uint32_t triangle = random_below(random, (uint32_t)triangles->count);
        const Vec3 vertex = aim_corner(triangles, triangle, random_below(random, 3));
        rays[i] = aim_at(origin, vertex);
    }
}

// A float between zero and coordinate, of its sign, whose distance from it is a float as well:
// both are multiples of the same unit, and neither needs more bits of them than coordinate.
static double exact_part(double coordinate, double part)
{
    if (coordinate == 0)
        return 0;
    const double unit = scalbn(1, ilogb(coordinate) - 23);
    return trunc(coordinate * part / unit) * unit;
}

void aim_exactly_at_vertices(TestRay *rays, size_t count, const Room *room,
                             const Triangles *triangles, Random *random)
{
    for (size_t i = 0; i < count;) {
        const uint32_t triangle = random_below(random, (uint32_t)triangles->count);
        const Vec3 vertex = aim_corner(triangles, triangle, random_below(random, 3));
        const Vec3 part = vec3_add(vec3(0.5, 0.5, 0.5), random_in_cube(random, 0.5));
        const Vec3 origin = {exact_part(vertex.x, part.x), exact_part(vertex.y, part.y),
                             exact_part(vertex.z, part.z)};
        rays[i] = aim_at(origin, vertex);
        if (room_contains(room, origin))
            i++;
    }
}

TestRay *aim_make_rays(size_t count)
{
    Error error = {0};
    TestRay *rays = memory_raw(count, sizeof *rays, &error);
    require(rays != NULL, &error);
    return rays;
}
