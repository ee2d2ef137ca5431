// SPDX-License-Identifier: MIT
// At the joint of a fine and a coarse mesh, vertices of the fine side lie inside edges of the
// coarse side. Rounding moves the vertices off the edges and opens true cracks. Rays may pass only
// through these cracks.
#include "support/exact.h"
#include "support/rig.h"
#include "support/shapes.h"

#define CELLS 7

// Returns the rotated square [-1, 1]^2. Its left half has two triangles, and its right half has 2 *
// CELLS^2.
static Scene joined_halves(const Vec3 axes[3])
{
    const Vec3 low = rotated(axes, vec3(-1, -1, 0)), middle = rotated(axes, vec3(0, -1, 0));
    const Vec3 up = vec3_scale(axes[1], 2);
    Scene scene = shape_scene(shape_plane(low, axes[0], up, 1));
    shape_add(&scene, shape_plane(middle, axes[0], up, CELLS), 1);
    return scene;
}

// Aims at points of the common edge. Every second point is a vertex of the fine half.
static void aim_at_joint(Rays rays, const Stage *stage, const Vec3 axes[3], Random *random)
{
    Vec3 from = {0};
    for (size_t i = 0; i < rays.count; i++) {
        double place = random_between(random, -0.99, 0.99);
        if (i % 2 == 0)
            place = -1 + 2.0 / CELLS * (1 + random_below(random, CELLS - 1));
        if (rays_move_origin(i, 64)) {
            from = random_in_cube(random, 2);
            from.z = random_between(random, 0.5, 3);
        }
        rays.data[i] = ray_between_in(stage, rotated(axes, from), rotated(axes, vec3(0, place, 0)));
    }
}

// The number of rays that pass, for each ray tracer and in exact arithmetic.
typedef struct {
    const Triangles *triangles;
    size_t leaks[TRACERS], true_leaks;
} Cracks;

// A ray is wrong if it passes although it clearly hits in exact arithmetic.
static bool judge_leak(void *context, const Traced *traced)
{
    Cracks *cracks = context;
    const Verdict verdict = exact_nearest(cracks->triangles, traced->ray);
    const bool leaks = traced->hit->id == NOTHING;
    cracks->leaks[traced->tracer] += leaks;
    cracks->true_leaks += traced->tracer == BY_CLRT && verdict.id == NOTHING;
    return leaks && verdict.id != NOTHING && verdict.clear;
}

EXTREME(a_joint_of_meshes_leaks_no_more_than_its_true_cracks_t09)
{
    Random random = {9};
    Outcome sum = {0};
    Cracks cracks = {0};
    FREED_BY(rays_free) const Rays rays = rays_make(tier_size(1000, 10000));
    for (int rotation = 0; rotation < 10; rotation++) {
        Vec3 axes[3];
        random_rotation(&random, axes);
        FREED_BY(rig_close) Rig rig = rig_open("T-09", *state, joined_halves(axes));
        aim_at_joint(rays, &rig.stage, axes, &random);
        cracks.triangles = &rig.stage.triangles;
        outcome_add(&sum, rig_judge(&rig, rays, judge_leak, &cracks));
    }
    assert_int_equal(cracks.leaks[BY_LIBRARY], sum.has_library ? cracks.leaks[BY_CLRT] : 0);
    outcome_report(sum,
                   "leaks=%zu oracle_leaks=%zu embree_default_leaks=%zu embree_robust_leaks=%zu",
                   cracks.leaks[BY_CLRT], cracks.true_leaks, cracks.leaks[BY_EMBREE_DEFAULT],
                   cracks.leaks[BY_EMBREE_ROBUST]);
}

FIXTURES(ray_batch_setup, ray_batch_teardown)
