// SPDX-License-Identifier: MIT
// Rays inside a closed shape must hit triangles whose inner sides they see. At a ridge, triangles
// whose outer sides face the ray are at the same distance. The test's shape is a star in which all
// steps of the kernels are exact.
#include "support/rig.h"
#include "support/shapes.h"

#define HALF_SIDE 4

// Returns a cube whose faces are pyramids that point inward. Their apexes are one unit from the
// cube's center.
static Mesh make_star(Random *random)
{
    static const double turns[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    Mesh mesh = shape_unfilled(30, 24);
    for (uint32_t face = 0; face < 6; face++) {
        const uint32_t axis = face / 2;
        const double sign = face % 2 == 0 ? -1 : 1;
        for (uint32_t corner = 0; corner < 5; corner++) {
            double at[3] = {0};
            at[axis] = corner < 4 ? sign * HALF_SIDE : sign;
            at[(axis + 1) % 3] = corner < 4 ? HALF_SIDE * turns[corner][0] : 0;
            at[(axis + 2) % 3] = corner < 4 ? HALF_SIDE * turns[corner][1] * sign : 0;
            shape_set_vertex(&mesh, 5 * face + corner, vec3(at[0], at[1], at[2]));
            if (corner == 4)
                continue;
            uint32_t *triangle = mesh.triangles[4 * face + corner];
            triangle[0] = 5 * face + corner;
            triangle[1] = 5 * face + (corner + 1) % 4;
            triangle[2] = 5 * face + 4;
        }
    }
    return shape_reordered(mesh, random);
}

static bool is_in_star(Vec3 point)
{
    const double at[3] = {fabs(point.x), fabs(point.y), fabs(point.z)};
    for (int axis = 0; axis < 3; axis++)
        if (fmax(at[(axis + 1) % 3], at[(axis + 2) % 3]) <= (at[axis] - 1) * HALF_SIDE / 3)
            return false;
    return true;
}

static Vec3 lattice_point(Random *random, int side, double step)
{
    double at[3];
    for (int axis = 0; axis < 3; axis++)
        at[axis] = step * ((double)random_below(random, (uint32_t)(2 * side + 1)) - side);
    return vec3(at[0], at[1], at[2]);
}

// Returns a point of an edge: one of its ends, or one, two or three quarters along it.
static Vec3 star_target(const Mesh *mesh, Random *random)
{
    const uint32_t *triangle = mesh->triangles[random_below(random, 24)];
    const uint32_t corner = random_below(random, 3);
    const Vec3 a = shape_vertex(mesh, triangle[corner]);
    const Vec3 b = shape_vertex(mesh, triangle[(corner + 1) % 3]);
    return vec3_add(a, vec3_scale(vec3_sub(b, a), 0.25 * random_below(random, 4)));
}

// Shearing is exact if the largest component of the direction is a power of two.
static bool is_exact(Vec3 direction)
{
    const double extent = vec3_extent(direction);
    return extent > 0 && ldexp(1, ilogb(extent)) == extent;
}

static void aim_at_star(const Rays *rays, const Mesh *mesh, const Stage *stage, Random *random)
{
    for (size_t i = 0; i < rays->count;) {
        const Vec3 eye = lattice_point(random, 8, 0.5), target = star_target(mesh, random);
        if (is_in_star(eye) && is_exact(vec3_sub(target, eye)))
            rays->data[i++] = ray_between_in(stage, eye, target);
    }
}

// A judge whose context is the star's Triangles. Misses, and hits on outer sides, are wrong. The
// star's center is on the inner side of every triangle.
static bool judge_seen_side(void *context, const Traced *traced)
{
    const Triangles *triangles = context;
    const uint32_t id = traced->hit->id;
    if (id == NOTHING)
        return true;
    const Vec3 a = corner_of(triangles, id, 0);
    const Vec3 normal = vec3_cross(vec3_sub(corner_of(triangles, id, 1), a),
                                   vec3_sub(corner_of(triangles, id, 2), a));
    const double along = vec3_dot(normal, vec3_of_floats(traced->ray->direction));
    return !(vec3_dot(normal, a) > 0 ? along > 0 : along < 0);
}

EXTREME(a_ray_through_a_ridge_or_a_vertex_hits_the_side_that_it_sees_t45)
{
    Random random = {45};
    Mesh mesh = make_star(&random);
    const Mesh copy = make_star(&(Random){45});
    Rig rig = rig_open("T-45", *state, shape_scene(mesh));
    const Rays rays = rays_make(tier_size(20000, 1000000));
    assert_true(rig.stage.normalization.scale == 0.125);
    aim_at_star(&rays, &copy, &rig.stage, &random);
    outcome_report(rig_judge(&rig, rays, judge_seen_side, &rig.stage.triangles), "shape=star");
    rays_free(&rays);
    rig_close(&rig);
}

FIXTURES(ray_batch_setup, ray_batch_teardown)
