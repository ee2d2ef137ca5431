// SPDX-License-Identifier: MIT
// Ten thousand triangles around one vertex: rays at it and along the spokes meet many of them at
// once, and of the nearest the lowest id must win.
#include "support/aim.h"
#include "support/check.h"
#include "support/shapes.h"
#include "support/tier.h"
#include "support/trial.h"

#include <stdlib.h>

#define TRIANGLES 10000
#define RAYS      50000

// Above the fan, whose apex is the origin of the frame.
static Vec3 point_above(Random *random)
{
    Vec3 point = random_in_cube(random, 0.5);
    point.z = random_between(random, 0.5, 2);
    return point;
}

// Half of the rays are sheared without rounding, so that it runs through the very apex and meets
// all triangles at once.
static void aim_at_apex(TestRay *rays, Random *random)
{
    Vec3 origin = {0};
    for (size_t i = 0; i < RAYS; i++) {
        if (aim_moves_origin(i, 8))
            origin = point_above(random);
        if (random_below(random, 2) == 0)
            origin.z = 1;
        rays[i] = aim_at(origin, vec3(0, 0, 0));
    }
}

static void aim_along_spokes(TestRay *rays, const Triangles *triangles, Random *random)
{
    Vec3 origin = {0};
    for (size_t i = 0; i < RAYS; i++) {
        if (aim_moves_origin(i, 64))
            origin = point_above(random);
        const Vec3 spoke = aim_corner(triangles, random_below(random, TRIANGLES), 1);
        const Vec3 target = vec3_scale(spoke, random_between(random, 0, 0.95));
        rays[i] = aim_at(origin, target);
    }
}

// How many of them are judged by each triangle alone.
static size_t judged_count(void)
{
    return tier_size(50, 1000);
}

// The smallest (t, id) of all triangles, and how many share its t.
static TestHit nearest_of(const RayBatch *batch, const TestRay *ray, TestHit *each, size_t *equals)
{
    TestHit nearest = {INFINITY, NOTHING};
    ray_batch_each(batch, ray, each);
    *equals = 0;
    for (int i = 0; i < TRIANGLES; i++) {
        if (each[i].t < nearest.t)
            *equals = 0;
        *equals += each[i].t <= nearest.t && each[i].t < INFINITY;
        if (each[i].t < nearest.t || (each[i].t == nearest.t && each[i].id < nearest.id))
            nearest = each[i];
    }
    return nearest;
}

// Whether it is the answer: of those that share the smallest t, the lowest id.  Doubles that differ
// may be one float here, and then any of those is.
static bool is_answer(const RayBatch *batch, const TestHit *hit, const TestHit *nearest,
                      const TestHit *each)
{
    if (batch->choice.precision == PRECISION_FP64)
        return hit->id < TRIANGLES && each[hit->id].t == nearest->t && hit->t == nearest->t;
    return hit->id == nearest->id && hit->t == nearest->t;
}

// How many of the first rays get another answer than the smallest (t, id); adds the number of those
// where several triangles share the smallest t to *ties.
static size_t wrong_answers(const RayBatch *batch, const TestRay *rays, size_t *ties)
{
    Error error = {0};
    size_t wrong = 0;
    const size_t count = judged_count();
    TestHit *hits = memory_raw(count, sizeof *hits, &error);
    TestHit *each = memory_raw(TRIANGLES, sizeof *each, &error);
    require(hits != NULL && each != NULL, &error);
    ray_batch_trace(batch, BATCH_NEAREST, rays, count, hits);
    for (size_t i = 0; i < count; i++) {
        size_t equals;
        const TestHit nearest = nearest_of(batch, &rays[i], each, &equals);
        wrong += !is_answer(batch, &hits[i], &nearest, each);
        *ties += equals > 1;
    }
    free(hits);
    free(each);
    return wrong;
}

static void fan_stage(Stage *stage)
{
    Scene scene = shape_scene(shape_fan(TRIANGLES));
    stage_make(stage, &scene, TREE_SAH);
    scene_free(&scene);
}

static void no_ray_slips_between_the_triangles_of_a_fan_t07(void **state)
{
    Stage stage;
    Trial trial;
    Random random = {7};
    TestRay *rays = aim_make_rays(RAYS);
    fan_stage(&stage);
    trial_open(&trial, "T-07", *state, &stage);
    aim_at_apex(rays, &random);
    size_t misses = trial_misses(&trial, "aim=apex", rays, RAYS);
    aim_along_spokes(rays, &stage.triangles, &random);
    misses += trial_misses(&trial, "aim=spokes", rays, RAYS);
    free(rays);
    trial_close(&trial);
    stage_free(&stage);
    assert_int_equal(misses, 0);
}

static void of_equally_near_triangles_the_lowest_id_is_hit_t07(void **state)
{
    Stage stage;
    Random random = {77};
    size_t apex_ties = 0, spoke_ties = 0;
    TestRay *rays = aim_make_rays(RAYS);
    fan_stage(&stage);
    ray_batch_upload(*state, &stage.flat);
    aim_at_apex(rays, &random);
    size_t wrong =
        report_case("T-07", "answer=apex", judged_count(), wrong_answers(*state, rays, &apex_ties));
    aim_along_spokes(rays, &stage.triangles, &random);
    wrong += report_case("T-07", "answer=spokes", judged_count(),
                         wrong_answers(*state, rays, &spoke_ties));
    free(rays);
    stage_free(&stage);
    assert_int_equal(wrong, 0);
    // Without ties this would test nothing.
    assert_in_range(apex_ties, judged_count() / 4, judged_count());
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_ray_slips_between_the_triangles_of_a_fan_t07),
        cmocka_unit_test(of_equally_near_triangles_the_lowest_id_is_hit_t07),
    };
    return cmocka_run_group_tests(tests, ray_batch_setup, ray_batch_teardown);
}
