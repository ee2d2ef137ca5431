// SPDX-License-Identifier: MIT
// A shadow ray stops at anything on its way, a camera ray at the nearest: between the same points
// they must say the same.
#include "support/aim.h"
#include "support/check.h"
#include "support/report.h"
#include "support/shapes.h"
#include "support/tier.h"

#include <stdlib.h>

// For hits this close to an end, the side that the end lies on decides.
#define NEAR_END 1e-4f

typedef enum {
    SEGMENT_FREE,     // between any two points
    SEGMENT_SURFACE,  // starts on a triangle, its own
    SEGMENT_ON_LIGHT, // ends exactly on a face
    SEGMENT_KINDS
} SegmentKind;

static const char *const segment_names[SEGMENT_KINDS] = {"free", "surface", "on_light"};

// A multiple of 2^-10 within the cube's half side in the frame.
static float lattice_place(Random *random)
{
    return (float)random_below(random, 1025) * 0x1p-10f - 0.5f;
}

static TestRay segment_from_surface(const Stage *stage, Vec3 light, Random *random)
{
    const uint32_t number = random_below(random, (uint32_t)stage->triangles.count);
    const double u = random_between(random, 0, 1), v = random_between(random, 0, 1 - u);
    const Vec3 a = aim_corner(&stage->triangles, number, 0);
    const Vec3 ab = vec3_sub(aim_corner(&stage->triangles, number, 1), a);
    const Vec3 ac = vec3_sub(aim_corner(&stage->triangles, number, 2), a);
    TestRay ray = aim_at(vec3_add(a, vec3_add(vec3_scale(ab, u), vec3_scale(ac, v))), light);
    ray.own = number;
    return ray;
}

static void make_segments(TestRay *rays, size_t count, SegmentKind kind, const Stage *stage,
                          Random *random)
{
    Vec3 light = {0};
    for (size_t i = 0; i < count; i++) {
        if (aim_moves_origin(i, 64))
            light = random_in_cube(random, 2);
        if (aim_moves_origin(i, 64) && kind == SEGMENT_ON_LIGHT)
            light = vec3((double)lattice_place(random), (double)lattice_place(random), 0.5);
        rays[i] = kind == SEGMENT_SURFACE ? segment_from_surface(stage, light, random)
                                          : aim_at(random_in_cube(random, 2), light);
    }
}

// Whether something stands between, by the nearest hit; *clear is false where that is too near an
// end to say.
static bool stands_between(const TestRay *ray, const TestHit *nearest, bool *clear)
{
    *clear = nearest->t > NEAR_END && fabsf(nearest->t - 1) > NEAR_END;
    if (nearest->id == ray->own && nearest->id != NOTHING)
        *clear = nearest->t > NEAR_END;
    return nearest->t < 1 && nearest->id != ray->own;
}

static size_t judge_segments(RayBatch *batch, const char *name, const Stage *stage,
                             SegmentKind kind)
{
    Error error = {0};
    Random random = {(uint64_t)(26 + kind)};
    size_t wrong = 0, judged = 0, blocked = 0;
    const size_t count = tier_size(10000, 100000);
    TestRay *rays = aim_make_rays(count);
    TestHit *nearest = memory_raw(count, sizeof *nearest, &error);
    TestHit *any = memory_raw(count, sizeof *any, &error);
    require(nearest != NULL && any != NULL, &error);
    make_segments(rays, count, kind, stage, &random);
    ray_batch_trace(batch, BATCH_NEAREST, rays, count, nearest);
    for (size_t i = 0; i < count; i++)
        rays[i].kind = RAY_SHADOW;
    ray_batch_trace(batch, BATCH_BLOCKED, rays, count, any);
    for (size_t i = 0; i < count; i++) {
        bool clear;
        const bool stands = stands_between(&rays[i], &nearest[i], &clear);
        judged += clear;
        blocked += clear && stands;
        wrong += clear && stands != (any[i].id == 1);
    }
    free(rays);
    free(nearest);
    free(any);
    char details[64];
    snprintf(details, sizeof details, "scene=%s segments=%s blocked=%zu", name, segment_names[kind],
             blocked);
    assert_in_range(judged, count / 4, count);
    return report_case("T-26", details, judged, wrong);
}

static size_t judge_scene(RayBatch *batch, const char *name, Mesh mesh)
{
    Stage stage;
    size_t wrong = 0;
    Scene scene = shape_scene(mesh);
    stage_make(&stage, &scene, TREE_SAH);
    scene_free(&scene);
    ray_batch_upload(batch, &stage.flat);
    for (SegmentKind kind = 0; kind < SEGMENT_KINDS; kind++)
        wrong += judge_segments(batch, name, &stage, kind);
    stage_free(&stage);
    return wrong;
}

static void anything_between_two_points_is_what_the_nearest_hit_says_t26(void **state)
{
    Random random = {2626};
    size_t wrong = judge_scene(*state, "cube", shape_cube(4, 8));
    wrong += judge_scene(*state, "soup", shape_soup(&random, 200, 0.3));
    wrong += judge_scene(*state, "globe", shape_sphere(16, vec3(0, 0, 0)));
    assert_int_equal(wrong, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(anything_between_two_points_is_what_the_nearest_hit_says_t26),
    };
    return cmocka_run_group_tests(tests, ray_batch_setup, ray_batch_teardown);
}
