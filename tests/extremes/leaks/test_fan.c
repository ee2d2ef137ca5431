// SPDX-License-Identifier: MIT
// Ten thousand triangles share a vertex. Rays aimed at this vertex and at edges must hit. Test 25
// compares the trees on a fan of 400 triangles. Test 20 checks, on a cube, that the lowest id wins
// among triangles at equal distances.
#include "support/rig.h"
#include "support/shapes.h"

#define TRIANGLES 10000

// Returns a point above the fan. The fan's apex is the origin of normalized coordinates.
static Vec3 point_above(Random *random)
{
    Vec3 point = random_in_cube(random, 0.5);
    point.z = random_between(random, 0.5, 2);
    return point;
}

// At least half of the rays start at z = 1. For these rays, the shear of the triangle test is
// exact, and all triangles are hit at the same distance.
static void aim_at_apex(Rays rays, Random *random)
{
    Vec3 origin = {0};
    for (size_t i = 0; i < rays.count; i++) {
        if (rays_move_origin(i, 8))
            origin = point_above(random);
        if (random_below(random, 2) == 0)
            origin.z = 1;
        rays.data[i] = ray_between(origin, vec3(0, 0, 0));
    }
}

static void aim_along_spokes(Rays rays, const Triangles *triangles, Random *random)
{
    Vec3 origin = {0};
    for (size_t i = 0; i < rays.count; i++) {
        if (rays_move_origin(i, 64))
            origin = point_above(random);
        const uint32_t triangle = random_below(random, TRIANGLES);
        rays.data[i] =
            ray_between(origin, point_of(triangles, triangle, random_between(random, 0, 0.95), 0));
    }
}

EXTREME(no_ray_slips_through_a_fan_t07)
{
    Random random = {7};
    FREED_BY(rays_free) const Rays at_apex = rays_make(tier_size(2500, 50000));
    FREED_BY(rays_free) const Rays at_spokes = rays_make(50000);
    FREED_BY(rig_close) Rig rig = rig_open("T-07", *state, shape_scene(shape_fan(TRIANGLES)));
    aim_at_apex(at_apex, &random);
    outcome_report(rig_judge(&rig, at_apex, judge_misses, NULL), "aim=apex");
    aim_along_spokes(at_spokes, &rig.stage.triangles, &random);
    outcome_report(rig_judge(&rig, at_spokes, judge_misses, NULL), "aim=spokes");
}

FIXTURES(ray_batch_setup, ray_batch_teardown)
