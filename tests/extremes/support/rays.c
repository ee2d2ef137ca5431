// SPDX-License-Identifier: MIT
// Random rays hardly ever find a gap, so most rays go to edges and vertices.
#include "rays.h"

#include "check.h"
#include "image/form.h"
#include "shapes.h"

Rays rays_make(size_t count)
{
    return (Rays){require_memory(count, sizeof(TestRay)), count};
}

void rays_free(const Rays *rays)
{
    free(rays->data);
}

bool rays_move_origin(size_t i, size_t bundle)
{
    return form_choice().family != FAMILY_PACKET || i % bundle == 0;
}

TestRay ray_between(Vec3 from, Vec3 to)
{
    TestRay ray = {.own = NOTHING, .kind = RAY_CAMERA};
    const double start[3] = {from.x, from.y, from.z}, end[3] = {to.x, to.y, to.z};
    for (int axis = 0; axis < 3; axis++) {
        ray.origin[axis] = (float)start[axis];
        ray.direction[axis] = (float)(end[axis] - shape_rounded(start[axis]));
    }
    return ray;
}

TestRay ray_between_in(const Stage *stage, Vec3 from, Vec3 to)
{
    return ray_between(normalize_point(&stage->normalization, from),
                       normalize_point(&stage->normalization, to));
}

Vec3 rays_target(Aim aim, const Triangles *triangles, Random *random)
{
    const uint32_t triangle = random_below(random, (uint32_t)triangles->count);
    const uint32_t corner = random_below(random, 3);
    const Vec3 a = corner_of(triangles, triangle, corner);
    const Vec3 b = corner_of(triangles, triangle, (corner + 1) % 3);
    const double along = aim == AIM_EDGES ? random_between(random, 0, 1) : 0;
    return vec3_add(a, vec3_scale(vec3_sub(b, a), along));
}

// Returns coordinate * part, truncated to a multiple of the coordinate's unit in the last place.
// `part` is from 0 to 1, so the result and its difference from the coordinate are floats.
static double exact_part(double coordinate, double part)
{
    if (coordinate == 0)
        return 0;
    const double unit = scalbn(1, ilogb(coordinate) - 23);
    return trunc(coordinate * part / unit) * unit;
}

// Chooses a vertex as target, and returns a point of the room whose difference from the target is
// exact.
static Vec3 exact_origin(Vec3 *target, const Room *room, const Triangles *triangles, Random *random)
{
    for (;;) {
        const Vec3 vertex = rays_target(AIM_VERTICES, triangles, random);
        const Vec3 part = vec3_add(vec3(0.5, 0.5, 0.5), random_in_cube(random, 0.5));
        const Vec3 origin = {exact_part(vertex.x, part.x), exact_part(vertex.y, part.y),
                             exact_part(vertex.z, part.z)};
        *target = vertex;
        if (room_contains(room, origin))
            return origin;
    }
}

void rays_aim(Rays rays, Aim aim, const Room *room, const Triangles *triangles, Random *random)
{
    Vec3 origin = {0}, target;
    for (size_t i = 0; i < rays.count; i++) {
        if (aim == AIM_VERTICES_EXACTLY)
            origin = exact_origin(&target, room, triangles, random);
        else if (rays_move_origin(i, RAY_BUNDLE))
            origin = room_point(room, random);
        if (aim == AIM_RANDOM)
            target = vec3_add(origin, random_in_cube(random, 1));
        else if (aim != AIM_VERTICES_EXACTLY)
            target = rays_target(aim, triangles, random);
        rays.data[i] = ray_between(origin, target);
    }
}
