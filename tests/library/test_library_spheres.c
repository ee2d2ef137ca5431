// SPDX-License-Identifier: MIT
// Rays hit the same spheres with and without a tree over the spheres, in packets and in single rays
// through both kinds of nodes. Most rays graze a sphere. Each run draws new scenes and rays.
#include "unit/cmocka_all.h"
#include "unit/random.h"

#include <clrt.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#define SPHERES 300
#define RAYS    20000

static double centers[SPHERES][3], radii[SPHERES];
static double origins[RAYS][3], directions[RAYS][3];

static uint64_t random_state;

static double uniform(double low, double high)
{
    return random_between(&random_state, low, high);
}

// Makes small and large spheres. Every fifth one touches the previous one or contains it, and the
// last one is a floor.
static ClrtScene *make_scene(void)
{
    ClrtScene *scene = clrt_scene_create(NULL);
    assert_non_null(scene);
    for (int i = 0; i < SPHERES; i++) {
        radii[i] = i == SPHERES - 1 ? 1e5 : exp2(uniform(-16, -2));
        for (int axis = 0; axis < 3; axis++)
            centers[i][axis] = uniform(-1, 1);
        if (i == SPHERES - 1)
            centers[i][2] = -1e5 - 1.5;
        if (i > 0 && i % 5 == 0) {
            memcpy(centers[i], centers[i - 1], sizeof centers[i]);
            centers[i][0] += radii[i] + (i % 2 == 0 ? radii[i - 1] : -radii[i - 1]);
        }
        assert_true(clrt_scene_add_sphere(scene, centers[i], radii[i], 0, NULL));
    }
    return scene;
}

// Aims a ray from inside or outside of the scene at a point near a sphere's outline. The point's
// distance from the sphere's center is about the radius, at about a right angle to the ray.
static void aim(double origin[3], double direction[3])
{
    const uint32_t target = random_below(&random_state, SPHERES);
    const double reach = exp2(uniform(-2, 6));
    const double miss =
        radii[target] * (1 + (random_below(&random_state, 2) ? 1 : -1) * exp2(uniform(-30, 0)));
    double aside[3], along = 0, length = 0;
    for (int axis = 0; axis < 3; axis++) {
        origin[axis] = uniform(-reach, reach);
        direction[axis] = centers[target][axis] - origin[axis];
        aside[axis] = uniform(-1, 1);
        along += aside[axis] * direction[axis];
        length += direction[axis] * direction[axis];
    }
    double size = 0;
    for (int axis = 0; axis < 3; axis++) {
        aside[axis] -= along / length * direction[axis];
        size += aside[axis] * aside[axis];
    }
    for (int axis = 0; axis < 3; axis++)
        direction[axis] += miss / sqrt(size) * aside[axis];
}

#define ROOM 4

typedef struct {
    double distances[RAYS], crossed[RAYS][ROOM];
    uint32_t primitives[RAYS], crossings[RAYS][ROOM], counts[RAYS];
    uint8_t occluded[RAYS];
} Found;

static void trace(const ClrtScene *scene, const ClrtSettings *settings, Found *found)
{
    ClrtRenderer *renderer = clrt_renderer_create(settings, NULL);
    const ClrtRays rays = {
        .size = sizeof rays, .count = RAYS, .origins = origins[0], .directions = directions[0]};
    const ClrtHits hits = {
        .size = sizeof hits, .distances = found->distances, .primitives = found->primitives};
    const ClrtHits all = {.size = sizeof all,
                          .distances = found->crossed[0],
                          .primitives = found->crossings[0],
                          .counts = found->counts,
                          .room = ROOM};
    assert_non_null(renderer);
    assert_true(clrt_trace(renderer, scene, &rays, &hits, NULL));
    assert_true(clrt_trace_all(renderer, scene, &rays, &all, NULL));
    assert_true(clrt_occluded(renderer, scene, &rays, found->occluded, NULL));
    clrt_renderer_free(renderer);
}

TEST(a_tree_over_spheres_changes_no_hit)
{
    static Found expected, found;
    const ClrtSettings all = {.size = sizeof all, .tree = CLRT_TREE_NONE};
    const ClrtSettings forms[] = {
        {.size = sizeof *forms},
        {.size = sizeof *forms, .kernel = CLRT_KERNEL_PAIR},
        {.size = sizeof *forms, .kernel = CLRT_KERNEL_WIDE, .lanes = 8},
    };
    random_state = (uint64_t)time(NULL);
    printf("seed %llu\n", (unsigned long long)random_state);
    for (int round = 0; round < 2; round++) {
        ClrtScene *scene = make_scene();
        for (int i = 0; i < RAYS; i++)
            aim(origins[i], directions[i]);
        trace(scene, &all, &expected);
        size_t hits = 0;
        for (int i = 0; i < RAYS; i++) {
            hits += expected.primitives[i] != CLRT_NOTHING;
            assert_int_equal(expected.crossings[i][0], expected.primitives[i]);
            assert_true(expected.crossed[i][0] == expected.distances[i]);
        }
        assert_in_range(hits, RAYS / 10, RAYS - RAYS / 100);
        for (size_t form = 0; form < sizeof forms / sizeof *forms; form++) {
            memset(&found, 0x55, sizeof found);
            trace(scene, &forms[form], &found);
            assert_memory_equal(&found, &expected, sizeof found);
        }
        clrt_scene_free(scene);
    }
}
