// SPDX-License-Identifier: MIT
// Rays from inside closed shapes at their edges and vertices, where triangle tests disagree first.
#include "support/aim.h"
#include "support/check.h"
#include "support/shapes.h"
#include "support/sphere_case.h"
#include "support/tier.h"

#include <stdlib.h>

static size_t rays_a_case(void)
{
    return tier_size(10000, 100000);
}

static void rays_at_edges_never_leave_a_closed_sphere_t02(void **state)
{
    size_t misses = 0;
    const size_t count = rays_a_case();
    TestRay *rays = aim_make_rays(count);
    for (int exponent = 0; exponent < SPHERE_EXPONENTS; exponent++) {
        char details[32];
        SphereCase sphere;
        Random random = {(uint64_t)(2000 + exponent)};
        if (!sphere_case_is_wanted(exponent))
            continue;
        sphere_case_make(&sphere, "T-02", *state, exponent);
        aim_at_edges(rays, count, &sphere.room, &sphere.stage.triangles, &random);
        snprintf(details, sizeof details, "k=%d", exponent);
        misses += trial_misses(&sphere.trial, details, rays, count);
        sphere_case_free(&sphere);
    }
    free(rays);
    assert_int_equal(misses, 0);
}

static void rays_at_vertices_never_leave_a_closed_sphere_t03(void **state)
{
    size_t misses = 0;
    const size_t count = rays_a_case();
    TestRay *rays = aim_make_rays(count);
    for (int exponent = 0; exponent < SPHERE_EXPONENTS; exponent++) {
        char details[64];
        SphereCase sphere;
        Random random = {(uint64_t)(3000 + exponent)};
        if (!sphere_case_is_wanted(exponent))
            continue;
        sphere_case_make(&sphere, "T-03", *state, exponent);
        const Triangles *triangles = &sphere.stage.triangles;
        aim_at_vertices(rays, count, &sphere.room, triangles, &random);
        snprintf(details, sizeof details, "k=%d aim=rounded", exponent);
        misses += trial_misses(&sphere.trial, details, rays, count);
        aim_exactly_at_vertices(rays, count, &sphere.room, triangles, &random);
        snprintf(details, sizeof details, "k=%d aim=exact", exponent);
        misses += trial_misses(&sphere.trial, details, rays, count);
        sphere_case_free(&sphere);
    }
    free(rays);
    assert_int_equal(misses, 0);
}

typedef enum { AIM_RANDOM, AIM_EDGES, AIM_VERTICES, AIM_KINDS } Aim;

static const char *const aim_names[AIM_KINDS] = {"random", "edges", "vertices"};

static void aim(Aim kind, TestRay *rays, const Room *room, const Triangles *triangles,
                Random *random)
{
    const size_t count = rays_a_case();
    if (kind == AIM_RANDOM)
        aim_randomly(rays, count, room, random);
    else if (kind == AIM_EDGES)
        aim_at_edges(rays, count, room, triangles, random);
    else
        aim_at_vertices(rays, count, room, triangles, random);
}

static size_t misses_in_bumpy_sphere(RayBatch *batch, int exponent, TestRay *rays)
{
    Stage stage;
    Trial trial;
    size_t misses = 0;
    Random random = {(uint64_t)(4000 + exponent)};
    const Vec3 center = shape_center(exponent);
    Scene scene = shape_scene(shape_bumpy(&random, center));
    stage_make(&stage, &scene, TREE_SAH);
    const Room room = room_inside(&stage, center, 1);
    trial_open(&trial, "T-04", batch, &stage);
    for (Aim kind = 0; kind < AIM_KINDS; kind++) {
        char details[64];
        aim(kind, rays, &room, &stage.triangles, &random);
        snprintf(details, sizeof details, "k=%d aim=%s", exponent, aim_names[kind]);
        misses += trial_misses(&trial, details, rays, rays_a_case());
    }
    trial_close(&trial);
    stage_free(&stage);
    scene_free(&scene);
    return misses;
}

static void no_ray_leaves_a_closed_bumpy_sphere_t04(void **state)
{
    size_t misses = 0;
    TestRay *rays = aim_make_rays(rays_a_case());
    for (int exponent = 0; exponent <= 20; exponent += tier() == 0 ? 10 : 5)
        misses += misses_in_bumpy_sphere(*state, exponent, rays);
    free(rays);
    assert_int_equal(misses, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_at_edges_never_leave_a_closed_sphere_t02),
        cmocka_unit_test(rays_at_vertices_never_leave_a_closed_sphere_t03),
        cmocka_unit_test(no_ray_leaves_a_closed_bumpy_sphere_t04),
    };
    return cmocka_run_group_tests(tests, ray_batch_setup, ray_batch_teardown);
}
