// SPDX-License-Identifier: MIT
// Traces rays at a mesh, a triangle about a million times larger, and one about a million times
// smaller.
#include "support/exact.h"
#include "support/rig.h"
#include "support/shapes.h"

#define SMALL_Y -2.5

// On the y axis, the large triangle is behind the globe, and the small one is in front of it. A
// third triangle at y = -1e6 keeps the center of the scene's bounds at the origin, so that the
// small triangle's coordinates stay exact.
static Scene three_scales(void)
{
    const double s = 1e-6, l = 1e6, y = SMALL_Y;
    const Mesh small = shape_triangle(vec3(-s, y, -s), vec3(s, y, -s), vec3(0, y, s));
    Scene scene = shape_scene(shape_sphere(12, vec3(0, 0, 0)));
    shape_add(&scene, shape_triangle(vec3(-l, l, -l), vec3(l, l, -l), vec3(0, l, l)), 1);
    shape_add(&scene, shape_triangle(vec3(-s, -l, -s), vec3(s, -l, 0), vec3(0, -l, s)), 1);
    shape_add(&scene, small, 1);
    return scene;
}

// Rays start close to the small triangle and go in turn to the small triangle, the globe and the
// large triangle.
static void aim_at_scales(Rays rays, const Stage *stage, Random *random)
{
    Vec3 from = {0};
    const double sizes[3] = {3e-6, 4, 2e6}, depths[3] = {SMALL_Y, 0, 1e6};
    for (size_t i = 0; i < rays.count; i++) {
        if (rays_move_origin(i, RAY_BUNDLE))
            from = vec3_add(vec3(0, SMALL_Y - 1e-5, 0), random_in_cube(random, 1e-6));
        Vec3 target = random_in_cube(random, sizes[i % 3] / 2);
        target.y = depths[i % 3];
        rays.data[i] = ray_between_in(stage, from, target);
        for (int axis = 0; axis < 3; axis++)
            rays.data[i].direction[axis] *= i % 3 == 0 ? 0x1p+36f : 1;
    }
}

EXTREME(triangles_of_three_scales_have_the_exact_hits_t18)
{
    Random random = {18};
    size_t clear = 0, small = 0;
    FREED_BY(rays_free) const Rays rays = rays_make(tier_size(6000, 99999));
    FREED_BY(rig_close) Rig rig = rig_open("T-18", *state, three_scales());
    Triangles *triangles = &rig.stage.triangles;
    aim_at_scales(rays, &rig.stage, &random);
    outcome_report(rig_judge(&rig, rays, judge_exactly, triangles), "scales=1e-6,1,1e6");
    for (size_t i = 0; i < rays.count; i++) {
        const Verdict verdict = exact_nearest(triangles, &rays.data[i]);
        clear += verdict.clear;
        small += verdict.clear && verdict.id == triangles->count - 1;
    }
    assert_in_range(clear, rays.count * 9 / 10, rays.count);
    assert_in_range(small, rays.count / 20, rays.count);
}

FIXTURES(ray_batch_setup, ray_batch_teardown)
