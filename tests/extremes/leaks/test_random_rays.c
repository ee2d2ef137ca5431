// SPDX-License-Identifier: MIT
// Random rays inside closed spheres that are ever farther from the origin.
#include "support/closed.h"

static void random_rays_never_leave_a_closed_sphere_t01(void **state)
{
    const ClosedTest test = {"T-01", "", 1000, CLOSED_AIM(AIM_RANDOM), tier_size(10000, 1000000)};
    closed_judge_spheres(*state, &test);
}

static void a_hundred_million_random_rays_never_leave_a_closed_sphere_t01(void **state)
{
    Outcome sum = {.test = "T-01"};
    Random random = {100};
    if (tier() < 2)
        return;
    const Rays rays = rays_make(1000000);
    Rig rig = rig_open("T-01", *state, closed_sphere(10));
    const Room room = room_inside(&rig.stage, shape_center(10), 1);
    peers_close(&rig.peers);
    for (int batch = 0; batch < 100; batch++) {
        rays_aim(rays, AIM_RANDOM, &room, &rig.stage.triangles, &random);
        outcome_add(&sum, rig_judge(&rig, rays, judge_misses, NULL));
    }
    outcome_report(sum, "soak k=10");
    rig_close(&rig);
    free(rays.data);
}

RUN_TESTS(ray_batch_setup, ray_batch_teardown, EXTREME(random_rays_never_leave_a_closed_sphere_t01),
          EXTREME(a_hundred_million_random_rays_never_leave_a_closed_sphere_t01))
