// SPDX-License-Identifier: MIT
// Triangles that no tree can separate: equal, concentric, or each half as large as the one before.
// Trees must stay shallow, and hits exact.
#include "support/rig.h"
#include "support/shapes.h"

#include "oracle/blocks.h"

static Mesh copies_of_a_triangle(size_t count)
{
    Mesh mesh = shape_unfilled(3, count);
    shape_set_vertex(&mesh, 0, vec3(-1, -1, 0));
    shape_set_vertex(&mesh, 1, vec3(1, -0.5, 0.25));
    shape_set_vertex(&mesh, 2, vec3(0, 1, 0.5));
    for (size_t i = 0; i < count; i++)
        for (uint32_t corner = 0; corner < 3; corner++)
            mesh.triangles[i][corner] = corner;
    return mesh;
}

static bool judge_first(void *unused, const Traced *traced)
{
    (void)unused;
    return traced->hit->id != 0;
}

static void of_a_million_copies_of_a_triangle_the_first_is_hit_t12(void **state)
{
    TestRay rays[64];
    Random random = {12};
    const size_t count = tier_size(10000, 1000000);
    Rig rig = rig_open("T-12", *state, shape_scene(copies_of_a_triangle(count)));
    peers_close(&rig.peers);
    for (size_t i = 0; i < COUNT(rays); i++)
        rays[i] = ray_between(vec3(0, 0, 2), random_in_cube(&random, 0.1));
    assert_in_range(rig.stage.bvh.depth, 1, BVH_MAX_DEPTH);
    outcome_report(rig_judge(&rig, (Rays){rays, COUNT(rays)}, judge_first, NULL),
                   "copies=%zu depth=%u largest_leaf=%u", count, rig.stage.bvh.depth,
                   rig.stage.bvh.largest_leaf);
    rig_close(&rig);
}

// Returns triangles around the origin, each with its own size and rotation.
static Mesh concentric_triangles(size_t count, Random *random)
{
    static const Vec3 corners[3] = {{1, 0, 0}, {-0.5, 0.75, 0}, {-0.5, -0.75, 0}};
    Mesh mesh = shape_unfilled(3 * count, count);
    for (uint32_t i = 0; i < count; i++) {
        Vec3 axes[3];
        const double size = (i + 1) / (double)count;
        random_rotation(random, axes);
        for (uint32_t corner = 0; corner < 3; corner++) {
            const uint32_t vertex = 3 * i + corner;
            shape_set_vertex(&mesh, vertex, rotated(axes, vec3_scale(corners[corner], size)));
            mesh.triangles[i][corner] = vertex;
        }
    }
    return mesh;
}

// The scene's triangles in fp64.
typedef struct {
    OracleBlocks blocks;
    Normalization normalization;
    OracleHit *expected; // by ray; set when clrt's hit is judged, before Embree's
} Witness;

// Another triangle is wrong only if it is farther than the errors of depth allow.
static bool judge_depth(void *context, const Traced *traced)
{
    const Witness *witness = context;
    const TestHit *hit = traced->hit;
    const Vec3 direction = vec3_of(traced->ray->direction);
    const OracleRay ray = {denormalize_point(&witness->normalization, vec3_of(traced->ray->origin)),
                           vec3_normalize(direction), 0, INFINITY, NOTHING};
    OracleHit *expected = &witness->expected[traced->index];
    if (traced->tracer == BY_CLRT) {
        *expected = (OracleHit){INFINITY, NOTHING};
        blocks_meet(&witness->blocks, &ray, expected);
    }
    const double length = sqrt(vec3_dot(direction, direction)) / witness->normalization.scale;
    return (hit->id != NOTHING) != (expected->id != NOTHING) ||
           (hit->id != expected->id && fabs((double)hit->t * length - expected->t) > 1e-4);
}

static void a_million_concentric_triangles_are_told_apart_t14(void **state)
{
    Error error = {0};
    Witness witness;
    Random random = {14};
    const size_t count = tier_size(10000, 1000000);
    const Rays rays = rays_make(tier_size(1000, 10000));
    Scene scene = shape_scene(concentric_triangles(count, &random));
    require(blocks_make(&witness.blocks, &scene, &error), &error);
    Rig rig = rig_open("T-14", *state, scene);
    witness.normalization = rig.stage.normalization;
    witness.expected = require_memory(rays.count, sizeof *witness.expected);
    for (size_t i = 0; i < rays.count; i++)
        rays.data[i] = ray_between(vec3(0.5, -2, 0.75), random_in_cube(&random, 0.4));
    assert_in_range(rig.stage.bvh.depth, 1, BVH_MAX_DEPTH);
    outcome_report(rig_judge(&rig, rays, judge_depth, &witness), "triangles=%zu depth=%u", count,
                   rig.stage.bvh.depth);
    rig_close(&rig);
    blocks_free(&witness.blocks);
    free(witness.expected);
    free(rays.data);
}

#define SPIRAL      121
#define SPIRAL_RAYS 100 // per triangle

// Returns triangles of size 2^-i at a distance of 2^-i from the origin.
static Scene spiral(void)
{
    Scene scene = shape_scene(shape_triangle(vec3(1, 0, 0), vec3(1, 1, 0.2), vec3(0, 1, 1)));
    for (int i = 1; i < SPIRAL; i++) {
        const double s = ldexp(1, -i);
        shape_add(&scene, shape_triangle(vec3(s, 0, 0), vec3(s, s, 0.2 * s), vec3(0, s, s)), 1);
    }
    return scene;
}

// Rays start a few of its sizes away from each triangle. Directions are about as long as 1, like a
// camera's.
static void aim_at_spiral(Rays rays, const Stage *stage, Random *random)
{
    for (size_t i = 0; i < rays.count; i++) {
        const int turn = (int)(i / SPIRAL_RAYS);
        const double u = random_between(random, 0, 1), v = random_between(random, 0, 1 - u);
        rays.data[i] = ray_between_in(stage, vec3_scale(vec3(2, 2.5, -1), ldexp(1, -turn)),
                                      vec3_scale(vec3(1 - v, u + v, 0.2 * u + v), ldexp(1, -turn)));
        for (int axis = 0; axis < 3; axis++)
            rays.data[i].direction[axis] *= (float)ldexp(1, turn);
    }
}

static void judge_spiral(RayBatch *batch, TreeKind tree)
{
    Random random = {16};
    const Rays rays = rays_make((size_t)SPIRAL * SPIRAL_RAYS);
    Rig rig = rig_open_with("T-16", batch, spiral(), tree);
    aim_at_spiral(rays, &rig.stage, &random);
    assert_in_range(rig.stage.bvh.depth, 1, BVH_MAX_DEPTH);
    outcome_report(rig_judge(&rig, rays, judge_exactly, &rig.stage.triangles), "tree=%s depth=%u",
                   tree_names[tree], rig.stage.bvh.depth);
    rig_close(&rig);
    free(rays.data);
}

static void a_spiral_of_ever_smaller_triangles_overflows_no_stack_t16(void **state)
{
    judge_spiral(*state, TREE_SAH);
    judge_spiral(*state, TREE_MIDPOINT);
}

RUN_TESTS(ray_batch_setup, ray_batch_teardown,
          EXTREME(of_a_million_copies_of_a_triangle_the_first_is_hit_t12),
          EXTREME(a_million_concentric_triangles_are_told_apart_t14),
          EXTREME(a_spiral_of_ever_smaller_triangles_overflows_no_stack_t16))
