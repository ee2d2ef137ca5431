// SPDX-License-Identifier: MIT
// Rays from inside closed shapes at their edges and vertices, where triangle tests fail first.
#include "support/closed.h"

static void rays_at_edges_never_leave_a_closed_sphere_t02(void **state)
{
    const ClosedTest test = {"T-02", "", 2000, CLOSED_AIM(AIM_EDGES), tier_size(10000, 100000)};
    closed_judge_spheres(*state, &test);
}

static void rays_at_vertices_never_leave_a_closed_sphere_t03(void **state)
{
    const unsigned aims = CLOSED_AIM(AIM_VERTICES) | CLOSED_AIM(AIM_VERTICES_EXACTLY);
    const ClosedTest test = {"T-03", "", 3000, aims, tier_size(10000, 100000)};
    closed_judge_spheres(*state, &test);
}

static void no_ray_leaves_a_closed_bumpy_sphere_t04(void **state)
{
    for (int exponent = 0; exponent <= 20; exponent += tier() == 0 ? 10 : 5) {
        Random random = {(uint64_t)(4000 + exponent)};
        Scene scene = shape_scene(shape_bumpy(&random, shape_center(exponent)));
        const ClosedTest test = {"T-04", "", random.state - (uint64_t)exponent, CLOSED_AIMS,
                                 tier_size(10000, 100000)};
        closed_judge(*state, scene, exponent, &test);
    }
}

RUN_TESTS(ray_batch_setup, ray_batch_teardown,
          EXTREME(rays_at_edges_never_leave_a_closed_sphere_t02),
          EXTREME(rays_at_vertices_never_leave_a_closed_sphere_t03),
          EXTREME(no_ray_leaves_a_closed_bumpy_sphere_t04))
