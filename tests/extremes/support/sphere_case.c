// SPDX-License-Identifier: MIT
// Shape, tree, room and upload.
#include "sphere_case.h"

#include "shapes.h"

void sphere_case_make(SphereCase *sphere, RayBatch *batch, int exponent)
{
    const Vec3 center = shape_center(exponent);
    Scene scene = shape_scene(shape_sphere(exponent < 20 ? 200 : 20, center));
    stage_make(&sphere->stage, &scene, TREE_SAH);
    scene_free(&scene);
    sphere->room = room_inside(&sphere->stage, center, 1);
    ray_batch_upload(batch, &sphere->stage.flat);
}

void sphere_case_free(SphereCase *sphere)
{
    stage_free(&sphere->stage);
}
