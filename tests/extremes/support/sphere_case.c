// SPDX-License-Identifier: MIT
// Shape, tree, room and upload.
#include "sphere_case.h"

#include "shapes.h"
#include "tier.h"

bool sphere_case_is_wanted(int exponent)
{
    return tier() > 0 || exponent == 0 || exponent == 10 || exponent == 18;
}

void sphere_case_make(SphereCase *sphere, const char *test, RayBatch *batch, int exponent)
{
    const Vec3 center = shape_center(exponent);
    Scene scene = shape_scene(shape_sphere(exponent < 20 ? 200 : 20, center));
    stage_make(&sphere->stage, &scene, TREE_SAH);
    scene_free(&scene);
    sphere->room = room_inside(&sphere->stage, center, 1);
    trial_open(&sphere->trial, test, batch, &sphere->stage);
}

void sphere_case_free(SphereCase *sphere)
{
    trial_close(&sphere->trial);
    stage_free(&sphere->stage);
}
