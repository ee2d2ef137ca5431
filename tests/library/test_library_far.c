// SPDX-License-Identifier: MIT
// Rays from far away hit spheres as exactly as the doubles of a ray allow.
#include "unit/cmocka_all.h"

#include <clrt.h>
#include <math.h>

enum { RAYS = 64 };

// Makes a unit sphere at the origin and, unless the radius is 0, a larger sphere below it.
static ClrtScene *scene_with(double radius)
{
    ClrtScene *scene = clrt_scene_create(NULL);
    assert_non_null(scene);
    assert_true(clrt_scene_add_sphere(scene, (const double[3]){0}, 1, 0, NULL));
    if (radius > 0)
        assert_true(
            clrt_scene_add_sphere(scene, (const double[3]){0, 0, -2 - radius}, radius, 0, NULL));
    return scene;
}

// Even rays pass the unit sphere's center at a distance of 0.99, and odd rays at 1.01. All rays are
// parallel to the diagonal of x and y.
static void aim(double origins[RAYS][3], double directions[RAYS][3], double far)
{
    for (int i = 0; i < RAYS; i++) {
        const double aside = (i % 2 == 0 ? 0.99 : 1.01) * sqrt(2), sign = i % 4 < 2 ? 1 : -1;
        origins[i][0] = sign * far;
        origins[i][1] = sign * far + aside;
        origins[i][2] = 0;
        directions[i][0] = directions[i][1] = -sign;
        directions[i][2] = 0;
    }
}

static void expect_hits(ClrtRenderer *renderer, const ClrtScene *scene, double far)
{
    static double origins[RAYS][3], directions[RAYS][3], distances[RAYS];
    uint32_t primitives[RAYS];
    const ClrtRays rays = {
        .size = sizeof rays, .count = RAYS, .origins = origins[0], .directions = directions[0]};
    const ClrtHits hits = {.size = sizeof hits, .distances = distances, .primitives = primitives};
    aim(origins, directions, far);
    assert_true(clrt_trace(renderer, scene, &rays, &hits, NULL));
    for (int i = 0; i < RAYS; i++) {
        assert_int_equal(primitives[i], i % 2 == 0 ? 0 : CLRT_NOTHING);
        assert_true(i % 2 != 0 || fabs(distances[i] - far) < 1);
    }
}

TEST(rays_from_far_away_hit_spheres)
{
    ClrtRenderer *renderer = clrt_renderer_create(NULL, NULL);
    assert_non_null(renderer);
    for (int larger = 0; larger < 2; larger++) {
        ClrtScene *scene = scene_with(larger * 1000.0);
        for (int power = 4; power <= 46; power += 6)
            expect_hits(renderer, scene, ldexp(1, power));
        clrt_scene_free(scene);
    }
    clrt_renderer_free(renderer);
}
