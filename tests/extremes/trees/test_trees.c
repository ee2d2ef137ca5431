// SPDX-License-Identifier: MIT
// Every tree finds what testing all primitives finds, bit by bit.
#include "support/aim.h"
#include "support/check.h"
#include "support/report.h"
#include "support/tier.h"
#include "support/tree_scenes.h"

#include <stdlib.h>
#include <string.h>

static size_t rays_a_case(void)
{
    return tier_size(10000, 100000);
}

static Vec3 random_corner(const Triangles *triangles, Random *random)
{
    const uint32_t triangle = random_below(random, (uint32_t)triangles->count);
    return aim_corner(triangles, triangle, random_below(random, 3));
}

// A point of a random triangle's edge, or of the line through it.
static Vec3 random_target(const Triangles *triangles, Random *random)
{
    const uint32_t triangle = random_below(random, (uint32_t)triangles->count);
    const Vec3 a = aim_corner(triangles, triangle, 0), b = aim_corner(triangles, triangle, 1);
    return vec3_add(a, vec3_scale(vec3_sub(b, a), random_between(random, -0.2, 1.2)));
}

static TestRay along_an_axis(Vec3 through, Random *random)
{
    const double directions[3] = {-1, 0, 1};
    const uint32_t axis = random_below(random, 3);
    const double sign = directions[2 * random_below(random, 2)];
    const Vec3 step = {axis == 0 ? sign : 0, axis == 1 ? sign : 0, axis == 2 ? sign : 0};
    TestRay ray = aim_at(vec3_sub(through, vec3_scale(step, 2)), through);
    for (uint32_t i = 0; i < 3; i++)
        ray.direction[i] = i == axis ? (float)sign : 0;
    return ray;
}

// Rays from everywhere to everywhere: random ones, at vertices and edges, from afar, from vertices
// themselves, and along the axes.
static void make_rays(TestRay *rays, const Triangles *triangles, Random *random)
{
    const size_t count = rays_a_case();
    Vec3 near = {0}, far = {0};
    for (size_t i = 0; i < count; i++) {
        if (aim_moves_origin(i, AIM_BUNDLE)) {
            near = random_in_cube(random, 2);
            far = random_in_cube(random, 1000);
        }
        Vec3 origin = near;
        Vec3 target = random_in_cube(random, 1);
        if (i % 8 == 1 || i % 8 == 2)
            target = random_corner(triangles, random);
        else if (i % 8 == 3 || i % 8 == 4)
            target = random_target(triangles, random);
        if (i % 8 == 4)
            origin = far;
        if (i % 8 == 5)
            origin = random_corner(triangles, random);
        rays[i] = aim_at(origin, target);
        if (i % 8 == 6)
            rays[i] = along_an_axis(random_corner(triangles, random), random);
    }
}

// Reflected rays from points of triangles at or near one of their edges, where their neighbors are
// met at distances that rounding can make zero or less; or shadow rays from there.
static void make_surface_rays(TestRay *rays, const Stage *stage, bool are_shadows, Random *random)
{
    const size_t count = rays_a_case();
    const Triangles *triangles = &stage->triangles;
    for (size_t i = 0; i < count; i++) {
        const uint32_t triangle = random_below(random, (uint32_t)triangles->count);
        const Vec3 a = aim_corner(triangles, triangle, 0), b = aim_corner(triangles, triangle, 1);
        const Vec3 c = aim_corner(triangles, triangle, 2);
        const Vec3 along = vec3_scale(vec3_sub(b, a), random_between(random, 0, 1));
        const double inward = scalbn(random_between(random, 0, 1), -(int)random_below(random, 30));
        const Vec3 edge = vec3_add(a, along);
        const Vec3 origin = vec3_add(edge, vec3_scale(vec3_sub(c, edge), inward));
        rays[i] = aim_at(origin, vec3_add(origin, random_in_cube(random, 1)));
        rays[i].own = stage->flat.sphere_count + triangle;
        rays[i].kind = are_shadows ? RAY_SHADOW : RAY_REFLECTED;
    }
}

// A tree's answers to some rays beside those of the same scene without one.
typedef struct {
    BatchTask task;
    TestRay *rays;
    TestHit *expected, *found;
} Comparison;

static Comparison comparison_make(BatchTask task)
{
    Error error = {0};
    const size_t count = rays_a_case();
    const Comparison comparison = {task, aim_make_rays(count),
                                   memory_raw(count, sizeof(TestHit), &error),
                                   memory_raw(count, sizeof(TestHit), &error)};
    require(comparison.expected != NULL && comparison.found != NULL, &error);
    return comparison;
}

static void comparison_free(Comparison *comparison)
{
    free(comparison->rays);
    free(comparison->expected);
    free(comparison->found);
}

static void trace_scene(const Comparison *comparison, RayBatch *batch, size_t number, TreeKind tree)
{
    Stage stage;
    Scene scene = tree_scene_make(number);
    TestHit *hits = tree == TREE_NONE ? comparison->expected : comparison->found;
    stage_make(&stage, &scene, tree);
    ray_batch_upload(batch, &stage.flat);
    ray_batch_trace(batch, comparison->task, comparison->rays, rays_a_case(), hits);
    stage_free(&stage);
    scene_free(&scene);
}

static size_t differences_of(const Comparison *comparison, RayBatch *batch, size_t number)
{
    const size_t count = rays_a_case();
    size_t differences = 0;
    trace_scene(comparison, batch, number, TREE_NONE);
    for (TreeKind tree = TREE_SAH; tree < TREE_NONE; tree++) {
        char details[64];
        size_t wrong = 0;
        trace_scene(comparison, batch, number, tree);
        for (size_t i = 0; i < count; i++)
            wrong += memcmp(&comparison->found[i], &comparison->expected[i], sizeof(TestHit)) != 0;
        snprintf(details, sizeof details, "scene=%s tree=%s task=%s", tree_scenes[number].name,
                 tree_names[tree], comparison->task == BATCH_NEAREST ? "nearest" : "blocked");
        differences += report_case("T-25", details, count, wrong);
    }
    return differences;
}

static void make_scene_rays(TestRay *rays, size_t number, BatchTask task, bool from_surfaces)
{
    Stage stage;
    Random random = {25 + number};
    Scene scene = tree_scene_make(number);
    stage_make(&stage, &scene, TREE_NONE);
    if (from_surfaces)
        make_surface_rays(rays, &stage, task == BATCH_BLOCKED, &random);
    else
        make_rays(rays, &stage.triangles, &random);
    stage_free(&stage);
    scene_free(&scene);
}

// A ray of twice the length meets its target halfway; others end there.
static void make_shadow_ray(TestRay *ray, bool doubled)
{
    ray->kind = RAY_SHADOW;
    for (int axis = 0; axis < 3 && doubled; axis++)
        ray->direction[axis] *= 2;
}

// Returns the least number of rays into the scenes that must hit something.
static size_t least_met(BatchTask task, size_t count)
{
    return task == BATCH_BLOCKED ? count / 100 : count / 20;
}

static size_t compare(RayBatch *batch, BatchTask task, bool from_surfaces)
{
    const size_t count = rays_a_case();
    const uint32_t none = task == BATCH_BLOCKED ? 0 : NOTHING;
    size_t differences = 0;
    Comparison comparison = comparison_make(task);
    for (size_t number = 0; number < TREE_SCENES; number++) {
        size_t met = 0;
        make_scene_rays(comparison.rays, number, task, from_surfaces);
        for (size_t i = 0; i < count && task == BATCH_BLOCKED && !from_surfaces; i++)
            make_shadow_ray(&comparison.rays[i], i % 16 < 8);
        differences += differences_of(&comparison, batch, number);
        for (size_t i = 0; i < count; i++)
            met += comparison.expected[i].id != none;
        assert_true(met >= least_met(task, count) || from_surfaces);
    }
    comparison_free(&comparison);
    return differences;
}

static void every_tree_finds_the_hits_that_testing_all_triangles_finds_t25(void **state)
{
    assert_int_equal(compare(*state, BATCH_NEAREST, false), 0);
}

static void every_tree_finds_what_rays_from_a_surface_hit_t25(void **state)
{
    assert_int_equal(compare(*state, BATCH_NEAREST, true), 0);
}

static void every_tree_finds_the_shadows_that_testing_all_triangles_finds_t25(void **state)
{
    assert_int_equal(compare(*state, BATCH_BLOCKED, false), 0);
}

static void every_tree_finds_what_shadows_a_surface_t25(void **state)
{
    assert_int_equal(compare(*state, BATCH_BLOCKED, true), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_tree_finds_the_hits_that_testing_all_triangles_finds_t25),
        cmocka_unit_test(every_tree_finds_what_rays_from_a_surface_hit_t25),
        cmocka_unit_test(every_tree_finds_the_shadows_that_testing_all_triangles_finds_t25),
        cmocka_unit_test(every_tree_finds_what_shadows_a_surface_t25),
    };
    return cmocka_run_group_tests(tests, ray_batch_setup, ray_batch_teardown);
}
