// SPDX-License-Identifier: MIT
// Where a fine mesh meets a coarse one, vertices lie on no edge of the other side and, rounded, a
// little beside it: there are true cracks.  A ray may only pass where one is.
#include "support/aim.h"
#include "support/check.h"
#include "support/exact.h"
#include "support/rotation.h"
#include "support/shapes.h"
#include "support/tier.h"
#include "support/trial.h"

#include <stdlib.h>

#define CELLS 7

// The square [-1, 1]^2, turned: its left half in two triangles, its right half in 2 * CELLS^2.
static Scene joined_halves(const Vec3 axes[3])
{
    const Vec3 low = rotated(axes, vec3(-1, -1, 0)), middle = rotated(axes, vec3(0, -1, 0));
    const Vec3 up = vec3_scale(axes[1], 2);
    Scene scene = shape_scene(shape_plane(low, axes[0], up, 1));
    shape_add(&scene, shape_plane(middle, axes[0], up, CELLS), 1);
    return scene;
}

// At points of the common edge, every other at a vertex of the fine half.
static void aim_at_joint(TestRay *rays, size_t count, const Stage *stage, const Vec3 axes[3],
                         Random *random)
{
    Vec3 from = {0};
    for (size_t i = 0; i < count; i++) {
        double place = random_between(random, -0.99, 0.99);
        if (i % 2 == 0)
            place = -1 + 2.0 / CELLS * (1 + random_below(random, CELLS - 1));
        if (aim_moves_origin(i, 64)) {
            from = random_in_cube(random, 2);
            from.z = random_between(random, 0.5, 3);
        }
        rays[i] = aim_at(normalize_point(&stage->normalization, rotated(axes, from)),
                         normalize_point(&stage->normalization, rotated(axes, vec3(0, place, 0))));
    }
}

#define PROGRAMS 3 // clrt and both modes of Embree

// How many rays pass: with each program in turn, and in exact arithmetic.
typedef struct {
    const Triangles *triangles;
    size_t leaks[PROGRAMS], true_leaks;
    int program;
} Cracks;

// Wrong is a ray that passes where the exact one does not, unless it passes an outline so closely
// that the rounding of corners decides.
static size_t count_leaks(void *context, const TestRay *rays, const TestHit *hits, size_t count)
{
    Cracks *cracks = context;
    size_t wrong = 0;
    for (size_t i = 0; i < count; i++) {
        const Verdict verdict = exact_nearest(cracks->triangles, &rays[i]);
        const bool leaks = hits[i].id == NOTHING;
        cracks->leaks[cracks->program] += leaks;
        cracks->true_leaks += cracks->program == 0 && verdict.id == NOTHING;
        wrong += leaks && verdict.id != NOTHING && verdict.clear;
    }
    cracks->program = (cracks->program + 1) % PROGRAMS;
    return wrong;
}

static void a_joint_of_meshes_leaks_no_more_than_its_true_cracks_t09(void **state)
{
    Random random = {9};
    Fails fails = {0};
    Cracks cracks = {0};
    const size_t each = tier_size(1000, 10000), rotations = 10;
    TestRay *rays = aim_make_rays(each);
    for (size_t i = 0; i < rotations; i++) {
        Stage stage;
        Trial trial;
        Vec3 axes[3];
        random_rotation(&random, axes);
        Scene scene = joined_halves(axes);
        stage_make(&stage, &scene, TREE_SAH);
        aim_at_joint(rays, each, &stage, axes, &random);
        trial_open(&trial, "T-09", *state, &stage);
        cracks.triangles = &stage.triangles;
        cracks.program = 0;
        const Fails more = trial_fails(&trial, rays, each, &(Judgment){count_leaks, &cracks});
        fails_add(&fails, &more);
        trial_close(&trial);
        stage_free(&stage);
        scene_free(&scene);
    }
    free(rays);
    char details[128];
    int length = snprintf(details, sizeof details, "leaks=%zu oracle_leaks=%zu", cracks.leaks[0],
                          cracks.true_leaks);
    if (fails.peers.known)
        snprintf(details + length, sizeof details - (size_t)length,
                 " embree_default_leaks=%zu embree_robust_leaks=%zu", cracks.leaks[1],
                 cracks.leaks[2]);
    assert_int_equal(report_fails("T-09", details, rotations * each, &fails), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_joint_of_meshes_leaks_no_more_than_its_true_cracks_t09),
    };
    return cmocka_run_group_tests(tests, ray_batch_setup, ray_batch_teardown);
}
