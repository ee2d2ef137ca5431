// SPDX-License-Identifier: MIT
// Triangles that no tree can part: equal, concentric, coplanar, or each half as large as the one
// before.  Trees still stay shallow, and hits exact.
#include "support/aim.h"
#include "support/check.h"
#include "support/exact.h"
#include "support/rotation.h"
#include "support/shapes.h"
#include "support/tier.h"
#include "support/trial.h"

#include "oracle/blocks.h"

#include <stdlib.h>
#include <string.h>

static Mesh copies_of_a_triangle(size_t count)
{
    static const double corners[3][3] = {{-1, -1, 0}, {1, -0.5, 0.25}, {0, 1, 0.5}};
    Mesh mesh = shape_unfilled(3, count);
    memcpy(mesh.positions, corners, sizeof corners);
    for (size_t i = 0; i < count; i++)
        for (uint32_t corner = 0; corner < 3; corner++)
            mesh.triangles[i][corner] = corner;
    return mesh;
}

#define COPY_RAYS 64

static void of_a_million_copies_of_a_triangle_the_first_is_hit_t12(void **state)
{
    Stage stage;
    char details[96];
    Random random = {12};
    TestRay rays[COPY_RAYS];
    TestHit hits[COPY_RAYS];
    size_t wrong = 0;
    const size_t count = tier_size(10000, 1000000);
    Scene scene = shape_scene(copies_of_a_triangle(count));
    stage_make(&stage, &scene, TREE_SAH);
    ray_batch_upload(*state, &stage.flat);
    for (int i = 0; i < COPY_RAYS; i++)
        rays[i] = aim_at(vec3(0, 0, 2), vec3_scale(random_in_cube(&random, 0.1), 1));
    ray_batch_trace(*state, BATCH_NEAREST, rays, COPY_RAYS, hits);
    for (int i = 0; i < COPY_RAYS; i++)
        wrong += hits[i].id != 0;
    snprintf(details, sizeof details, "copies=%zu depth=%u largest_leaf=%u", count, stage.bvh.depth,
             stage.bvh.largest_leaf);
    report_case("T-12", details, COPY_RAYS, wrong);
    assert_in_range(stage.bvh.depth, 1, BVH_MAX_DEPTH);
    stage_free(&stage);
    scene_free(&scene);
    assert_int_equal(wrong, 0);
}

// Triangles around the origin, each of another size and turned another way.
static Mesh concentric_triangles(size_t count, Random *random)
{
    static const Vec3 corners[3] = {{1, 0, 0}, {-0.5, 0.75, 0}, {-0.5, -0.75, 0}};
    Mesh mesh = shape_unfilled(3 * count, count);
    for (uint32_t i = 0; i < count; i++) {
        Vec3 axes[3];
        const double size = (i + 1) / (double)count;
        random_rotation(random, axes);
        for (uint32_t corner = 0; corner < 3; corner++) {
            const Vec3 place = rotated(axes, vec3_scale(corners[corner], size));
            mesh.positions[3 * i + corner][0] = shape_rounded(place.x);
            mesh.positions[3 * i + corner][1] = shape_rounded(place.y);
            mesh.positions[3 * i + corner][2] = shape_rounded(place.z);
            mesh.triangles[i][corner] = 3 * i + corner;
        }
    }
    return mesh;
}

// The triangles as they are traced, in fp64, and room for a million of them.
typedef struct {
    OracleBlocks blocks;
    Scene scene;
    OracleHit *expected; // for each ray, in multiples of its direction of length 1
} Witnesses;

static void witnesses_make(Witnesses *witnesses, const Triangles *triangles)
{
    Error error = {0};
    Mesh mesh = shape_unfilled(triangles->point_count, triangles->count);
    for (size_t i = 0; i < triangles->point_count; i++)
        for (int axis = 0; axis < 3; axis++)
            mesh.positions[i][axis] = (double)triangles->points[i][axis];
    memcpy(mesh.triangles, triangles->corners, triangles->count * sizeof *mesh.triangles);
    witnesses->scene = shape_scene(mesh);
    require(blocks_make(&witnesses->blocks, &witnesses->scene, &error), &error);
}

static void witnesses_free(Witnesses *witnesses)
{
    free(witnesses->expected);
    blocks_free(&witnesses->blocks);
    scene_free(&witnesses->scene);
}

static double length_of(const TestRay *ray)
{
    const Vec3 along = {(double)ray->direction[0], (double)ray->direction[1],
                        (double)ray->direction[2]};
    return sqrt(vec3_dot(along, along));
}

// All triangles are tested for every ray, once for all programs.
static void witnesses_trace(Witnesses *witnesses, const TestRay *rays, size_t count)
{
    Error error = {0};
    witnesses->expected = memory_raw(count, sizeof *witnesses->expected, &error);
    require(witnesses->expected != NULL, &error);
    for (size_t i = 0; i < count; i++) {
        const float *o = rays[i].origin, *d = rays[i].direction;
        const Vec3 along = {(double)d[0], (double)d[1], (double)d[2]};
        const OracleRay exact = {{(double)o[0], (double)o[1], (double)o[2]},
                                 vec3_scale(along, 1 / length_of(&rays[i])),
                                 0,
                                 INFINITY,
                                 NOTHING};
        witnesses->expected[i] = (OracleHit){INFINITY, NOTHING};
        blocks_meet(&witnesses->blocks, &exact, &witnesses->expected[i]);
    }
}

// Another triangle is wrong only where it is farther by more than depths are off.
static size_t count_farther(void *context, const TestRay *rays, const TestHit *hits, size_t count)
{
    size_t wrong = 0;
    const Witnesses *witnesses = context;
    for (size_t i = 0; i < count; i++) {
        const OracleHit *expected = &witnesses->expected[i];
        const double t = (double)hits[i].t * length_of(&rays[i]);
        const bool met = hits[i].id != NOTHING;
        wrong += met != (expected->id != NOTHING) ||
                 (hits[i].id != expected->id && fabs(t - expected->t) > 1e-4);
    }
    return wrong;
}

static void a_million_concentric_triangles_are_told_apart_t14(void **state)
{
    Stage stage;
    Trial trial;
    Witnesses witnesses;
    char details[96];
    Random random = {14};
    const size_t count = tier_size(10000, 1000000), ray_count = tier_size(1000, 10000);
    TestRay *rays = aim_make_rays(ray_count);
    Scene scene = shape_scene(concentric_triangles(count, &random));
    stage_make(&stage, &scene, TREE_SAH);
    scene_free(&scene);
    witnesses_make(&witnesses, &stage.triangles);
    const Vec3 from = {0.5, -2, 0.75};
    for (size_t i = 0; i < ray_count; i++)
        rays[i] = aim_at(from, random_in_cube(&random, 0.4));
    witnesses_trace(&witnesses, rays, ray_count);
    trial_open(&trial, "T-14", *state, &stage);
    snprintf(details, sizeof details, "triangles=%zu depth=%u", count, stage.bvh.depth);
    const size_t wrong =
        trial_judge(&trial, details, rays, ray_count, &(Judgment){count_farther, &witnesses});
    assert_in_range(stage.bvh.depth, 1, BVH_MAX_DEPTH);
    trial_close(&trial);
    witnesses_free(&witnesses);
    stage_free(&stage);
    free(rays);
    assert_int_equal(wrong, 0);
}

#define SPIRAL 121

// Triangle i has the size 2^-i and lies as far from the origin.
static Scene spiral(void)
{
    Scene scene = shape_scene(shape_triangle(vec3(1, 0, 0), vec3(1, 1, 0.2), vec3(0, 1, 1)));
    for (int i = 1; i < SPIRAL; i++) {
        const double s = ldexp(1, -i);
        shape_add(&scene, shape_triangle(vec3(s, 0, 0), vec3(s, s, 0.2 * s), vec3(0, s, s)), 1);
    }
    return scene;
}

// Places of the spiral in the frame; the origin of the file is its limit.
static Vec3 spiral_place(const Stage *stage, int exponent, Vec3 place)
{
    return normalize_point(&stage->normalization, vec3_scale(place, ldexp(1, -exponent)));
}

// From a few sizes of the triangle away, at it; directions are about as long as 1, as a camera's.
static void aim_at_turn(TestRay *rays, size_t count, const Stage *stage, int turn, Random *random)
{
    const Vec3 from = spiral_place(stage, turn, vec3(2, 2.5, -1));
    const float longer = (float)ldexp(1, turn);
    for (size_t i = 0; i < count; i++) {
        const double u = random_between(random, 0, 1), v = random_between(random, 0, 1 - u);
        const Vec3 target = {1 - v, u + v, 0.2 * u + v};
        rays[i] = aim_at(from, spiral_place(stage, turn, target));
        for (int axis = 0; axis < 3; axis++)
            rays[i].direction[axis] *= longer;
    }
}

static size_t judge_spiral(RayBatch *batch, TreeKind tree)
{
    Stage stage;
    Trial trial;
    char details[96];
    Random random = {16};
    const size_t each = 100;
    TestRay *rays = aim_make_rays(SPIRAL * each);
    Scene scene = spiral();
    stage_make(&stage, &scene, tree);
    for (int turn = 0; turn < SPIRAL; turn++)
        aim_at_turn(rays + (size_t)turn * each, each, &stage, turn, &random);
    trial_open(&trial, "T-16", batch, &stage);
    snprintf(details, sizeof details, "tree=%s depth=%u", tree_names[tree], stage.bvh.depth);
    const size_t wrong = trial_judge(&trial, details, rays, SPIRAL * each,
                                     &(Judgment){exact_count_wrong, &stage.triangles});
    assert_in_range(stage.bvh.depth, 1, BVH_MAX_DEPTH);
    trial_close(&trial);
    stage_free(&stage);
    scene_free(&scene);
    free(rays);
    return wrong;
}

static void a_spiral_of_ever_smaller_triangles_overflows_no_stack_t16(void **state)
{
    const size_t wrong = judge_spiral(*state, TREE_SAH) + judge_spiral(*state, TREE_MIDPOINT);
    assert_int_equal(wrong, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(of_a_million_copies_of_a_triangle_the_first_is_hit_t12),
        cmocka_unit_test(a_million_concentric_triangles_are_told_apart_t14),
        cmocka_unit_test(a_spiral_of_ever_smaller_triangles_overflows_no_stack_t16),
    };
    return cmocka_run_group_tests(tests, ray_batch_setup, ray_batch_teardown);
}
