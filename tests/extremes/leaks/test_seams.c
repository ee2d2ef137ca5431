// SPDX-License-Identifier: MIT
// Rays through the seams of open shapes: a target well inside the outline must be met.
#include "support/aim.h"
#include "support/check.h"
#include "support/rotation.h"
#include "support/shapes.h"
#include "support/tier.h"
#include "support/trial.h"

#include <stdlib.h>

#define ROTATED_RAYS 1024

// Rays from one side of the unit quad that axes 0 and 1 span to points of its diagonal.
static void aim_at_diagonal(TestRay *rays, const Stage *stage, const Vec3 axes[3], Random *random)
{
    Vec3 from = {0};
    for (size_t i = 0; i < ROTATED_RAYS; i++) {
        const double place = random_between(random, 0.01, 0.99);
        if (aim_moves_origin(i, 64)) {
            from = random_in_cube(random, 2);
            from.z = random_between(random, 0.5, 3);
        }
        const Vec3 target = rotated(axes, vec3(place, place, 0));
        rays[i] = aim_at(normalize_point(&stage->normalization, rotated(axes, from)),
                         normalize_point(&stage->normalization, target));
    }
}

static Fails misses_through_diagonal(RayBatch *batch, const Vec3 axes[3], Random *random)
{
    Stage stage;
    Trial trial;
    TestRay rays[ROTATED_RAYS];
    Scene scene = shape_scene(shape_plane(vec3(0, 0, 0), axes[0], axes[1], 1));
    stage_make(&stage, &scene, TREE_SAH);
    aim_at_diagonal(rays, &stage, axes, random);
    trial_open(&trial, "T-05", batch, &stage);
    const Fails misses = trial_fails(&trial, rays, ROTATED_RAYS, &judgment_misses);
    trial_close(&trial);
    stage_free(&stage);
    scene_free(&scene);
    return misses;
}

static void no_ray_slips_through_the_diagonal_of_a_rotated_quad_t05(void **state)
{
    Random random = {5};
    // A turn by 90 degrees around (1, 1, 1) first.
    const double a = 1.0 / 3, b = sqrt(a);
    const Vec3 turned[3] = {{a, a + b, a - b}, {a - b, a, a + b}, {a + b, a - b, a}};
    const size_t rotations = tier_size(100, 1000);
    char details[32];
    Fails misses = misses_through_diagonal(*state, turned, &random);
    for (size_t i = 1; i < rotations; i++) {
        Vec3 rotation[3], axes[3];
        random_rotation(&random, rotation);
        for (int axis = 0; axis < 3; axis++)
            axes[axis] = rotated(rotation, turned[axis]);
        const Fails more = misses_through_diagonal(*state, axes, &random);
        fails_add(&misses, &more);
    }
    snprintf(details, sizeof details, "rotations=%zu", rotations);
    assert_int_equal(report_fails("T-05", details, rotations * ROTATED_RAYS, &misses), 0);
}

#define PAIR_RAYS 50000

// Two triangles a b c and b a d that share the edge a b, with c and d on either side of it.
static Scene random_pair(Random *random)
{
    Vec3 corners[4];
    for (int corner = 0; corner < 4; corner++) {
        corners[corner] = random_in_cube(random, 0.5);
        corners[corner].z *= 0.2;
    }
    const Vec3 a = vec3_add(corners[0], vec3(0, 2, 0)), b = vec3_sub(corners[1], vec3(0, 2, 0));
    const Vec3 c = vec3_add(corners[2], vec3(2, 0, 0)), d = vec3_sub(corners[3], vec3(2, 0, 0));
    Scene scene = shape_scene(shape_triangle(a, b, c));
    shape_add(&scene, shape_triangle(b, a, d), 1);
    return scene;
}

static Fails misses_through_pair(RayBatch *batch, Random *random, TestRay *rays)
{
    Stage stage;
    Trial trial;
    Scene scene = random_pair(random);
    stage_make(&stage, &scene, TREE_SAH);
    const Vec3 a = aim_corner(&stage.triangles, 0, 0);
    const Vec3 b = aim_corner(&stage.triangles, 0, 1);
    Vec3 from = {0};
    for (size_t i = 0; i < PAIR_RAYS; i++) {
        const Vec3 along = vec3_scale(vec3_sub(b, a), random_between(random, 0.01, 0.99));
        if (aim_moves_origin(i, 64))
            from = vec3_add(random_in_cube(random, 1), vec3(0, 0, 3));
        rays[i] = aim_at(normalize_point(&stage.normalization, from), vec3_add(a, along));
    }
    trial_open(&trial, "T-06", batch, &stage);
    const Fails misses = trial_fails(&trial, rays, PAIR_RAYS, &judgment_misses);
    trial_close(&trial);
    stage_free(&stage);
    scene_free(&scene);
    return misses;
}

static size_t misses_through_pairs(RayBatch *batch, const char *details)
{
    Random random = {6};
    Fails misses = {0};
    TestRay *rays = aim_make_rays(PAIR_RAYS);
    const size_t pairs = tier_size(2, 8);
    for (size_t pair = 0; pair < pairs; pair++) {
        const Fails more = misses_through_pair(batch, &random, rays);
        fails_add(&misses, &more);
    }
    free(rays);
    return report_fails("T-06", details, pairs * PAIR_RAYS, &misses);
}

static void no_ray_slips_between_two_triangles_whether_contracted_or_not_t06(void **state)
{
    RayBatch contracted;
    size_t misses = misses_through_pairs(*state, "contraction=off");
    ray_batch_open(&contracted, CONTRACTED_KERNELS, NULL);
    misses += misses_through_pairs(&contracted, "contraction=on");
    ray_batch_close(&contracted);
    assert_int_equal(misses, 0);
}

#define PLANE_X 148376.0

typedef enum { PLANE_POINTS, PLANE_EDGES, PLANE_VERTICES } PlaneTarget;

// A point of the plane, of one of its lines or of its vertices, in the file's coordinates.
static Vec3 plane_target(PlaneTarget kind, Random *random)
{
    const double cell = 12.0 / 200;
    Vec3 target = {PLANE_X, random_between(random, -5.9, 5.9), random_between(random, -5.9, 5.9)};
    if (kind != PLANE_POINTS)
        target.y = shape_rounded(-6 + cell * rint((target.y + 6) / cell));
    if (kind == PLANE_VERTICES)
        target.z = shape_rounded(-6 + cell * rint((target.z + 6) / cell));
    return target;
}

// The farther the rays come from, the smaller their angles with each other.
static size_t misses_of_plane(const Trial *trial, const Stage *stage, double distance,
                              PlaneTarget kind)
{
    static const char *const names[] = {"points", "edges", "vertices"};
    char details[64];
    Random random = {(uint64_t)(8000 + kind)};
    const size_t count = tier_size(20000, 250000);
    TestRay *rays = aim_make_rays(count);
    Vec3 from = {0};
    for (size_t i = 0; i < count; i++) {
        if (aim_moves_origin(i, 64))
            from = vec3_sub(random_in_cube(&random, 2), vec3(distance - PLANE_X, 0, 0));
        const Vec3 target = plane_target(kind, &random);
        rays[i] = aim_at(normalize_point(&stage->normalization, from),
                         normalize_point(&stage->normalization, target));
    }
    snprintf(details, sizeof details, "aim=%s distance=%g", names[kind], distance);
    const size_t misses = trial_misses(trial, details, rays, count);
    free(rays);
    return misses;
}

static void no_ray_passes_a_plane_far_from_the_origin_t08(void **state)
{
    Stage stage;
    Trial trial;
    size_t misses = 0;
    Scene scene =
        shape_scene(shape_plane(vec3(PLANE_X, -6, -6), vec3(0, 12, 0), vec3(0, 0, 12), 200));
    stage_make(&stage, &scene, TREE_SAH);
    trial_open(&trial, "T-08", *state, &stage);
    misses += misses_of_plane(&trial, &stage, 2.5, PLANE_POINTS);
    misses += misses_of_plane(&trial, &stage, 2.5, PLANE_EDGES);
    misses += misses_of_plane(&trial, &stage, 2.5, PLANE_VERTICES);
    misses += misses_of_plane(&trial, &stage, PLANE_X, PLANE_EDGES);
    trial_close(&trial);
    stage_free(&stage);
    scene_free(&scene);
    assert_int_equal(misses, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_ray_slips_through_the_diagonal_of_a_rotated_quad_t05),
        cmocka_unit_test(no_ray_slips_between_two_triangles_whether_contracted_or_not_t06),
        cmocka_unit_test(no_ray_passes_a_plane_far_from_the_origin_t08),
    };
    return cmocka_run_group_tests(tests, ray_batch_setup, ray_batch_teardown);
}
