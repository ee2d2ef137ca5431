// SPDX-License-Identifier: MIT
// A mesh of size 1 between a triangle a million times as large and one a million times smaller.
#include "support/aim.h"
#include "support/check.h"
#include "support/exact.h"
#include "support/shapes.h"
#include "support/tier.h"
#include "support/trial.h"

#include <stdlib.h>

#define GLOBE_RINGS 12

// The large triangle lies behind, the small one in front of the globe, on the axis y.
static Scene three_scales(void)
{
    Scene scene = shape_scene(shape_sphere(GLOBE_RINGS, vec3(0, 0, 0)));
    shape_add(&scene,
              shape_triangle(vec3(-1e6, 1e6, -1e6), vec3(1e6, 1e6, -1e6), vec3(0, 1e6, 1e6)), 1);
    shape_add(&scene,
              shape_triangle(vec3(-1e-6, -1e6, -1e-6), vec3(1e-6, -1e6, 0), vec3(0, -1e6, 1e-6)),
              1);
    const double s = 1e-6, y = -2.5;
    shape_add(&scene, shape_triangle(vec3(-s, y, -s), vec3(s, y, -s), vec3(0, y, s)), 1);
    return scene;
}

// From around (0, -4, 0) at each of the three in turn; a triangle on the other side of the large
// one balances the bounds, so that the frame keeps the place of the small one.
static void aim_at_scales(TestRay *rays, size_t count, const Stage *stage, Random *random)
{
    Vec3 from = {0};
    const double sizes[3] = {3e-6, 4, 2e6};
    for (size_t i = 0; i < count; i++) {
        const double size = sizes[i % 3];
        if (aim_moves_origin(i, AIM_BUNDLE))
            from = vec3_add(vec3(0, -2.5 - 1e-5, 0), random_in_cube(random, 1e-6));
        Vec3 target = random_in_cube(random, size / 2);
        target.y = i % 3 == 0 ? -2.5 : i % 3 == 1 ? 0 : 1e6;
        rays[i] = aim_at(normalize_point(&stage->normalization, from),
                         normalize_point(&stage->normalization, target));
        for (int axis = 0; axis < 3; axis++)
            rays[i].direction[axis] *= i % 3 == 0 ? 0x1p+36f : 1;
    }
}

static void triangles_of_three_scales_are_all_hit_where_they_are_t18(void **state)
{
    Stage stage;
    Trial trial;
    Random random = {18};
    const size_t count = tier_size(6000, 99999);
    TestRay *rays = aim_make_rays(count);
    Scene scene = three_scales();
    stage_make(&stage, &scene, TREE_SAH);
    aim_at_scales(rays, count, &stage, &random);
    trial_open(&trial, "T-18", *state, &stage);
    const size_t wrong = trial_judge(&trial, "scales=1e-6,1,1e6", rays, count,
                                     &(Judgment){exact_count_wrong, &stage.triangles});
    size_t clear = 0, small = 0;
    for (size_t i = 0; i < count; i++) {
        const Verdict verdict = exact_nearest(&stage.triangles, &rays[i]);
        clear += verdict.clear;
        small += verdict.clear && verdict.id == stage.triangles.count - 1;
    }
    trial_close(&trial);
    stage_free(&stage);
    scene_free(&scene);
    free(rays);
    assert_in_range(clear, count * 9 / 10, count);
    assert_in_range(small, count / 20, count);
    assert_int_equal(wrong, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(triangles_of_three_scales_are_all_hit_where_they_are_t18),
    };
    return cmocka_run_group_tests(tests, ray_batch_setup, ray_batch_teardown);
}
