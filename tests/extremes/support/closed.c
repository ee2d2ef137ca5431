// SPDX-License-Identifier: MIT
// Rays start in the cube of half side 1 around the shape's center.
#include "closed.h"

static const char *const aim_names[AIM_KINDS] = {"random", "edges", "vertices", "vertices_exactly"};

Scene closed_sphere(int exponent)
{
    return shape_scene(shape_sphere(exponent < 20 ? 200 : 20, shape_center(exponent)));
}

void closed_judge(RayBatch *batch, Scene scene, int exponent, const ClosedTest *test)
{
    Random random = {test->seed + (uint64_t)exponent};
    const Rays rays = rays_make(test->rays);
    Rig rig = rig_open(test->test, batch, scene);
    const Room room = room_inside(&rig.stage, shape_center(exponent), 1);
    for (Aim aim = 0; aim < AIM_KINDS; aim++) {
        if ((test->aims & CLOSED_AIM(aim)) == 0)
            continue;
        rays_aim(rays, aim, &room, &rig.stage.triangles, &random);
        outcome_report(rig_judge(&rig, rays, judge_misses, NULL), "%sk=%d aim=%s", test->label,
                       exponent, aim_names[aim]);
    }
    rig_close(&rig);
    free(rays.data);
}

void closed_judge_spheres(RayBatch *batch, const ClosedTest *test)
{
    for (int exponent = 0; exponent < 24; exponent++)
        if (tier() > 0 || exponent == 0 || exponent == 10 || exponent == 18)
            closed_judge(batch, closed_sphere(exponent), exponent, test);
}
