// SPDX-License-Identifier: MIT
// A ball on a mirror, as PFM: cc picture.c -o picture $(pkg-config --cflags --libs clrt)
#include <clrt.h>
#include <stdio.h>

int main(void)
{
    static float rgb[240][320][3];
    static const double corners[][3] = {{-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0}};
    static const uint32_t halves[][3] = {{0, 1, 2}, {0, 2, 3}};
    static const double ball[] = {0, 0, 1}, lamp[] = {4, -2, 6};
    const ClrtMesh ground = {.size = sizeof ground,
                             .positions = corners[0],
                             .triangles = halves[0],
                             .vertex_count = 4,
                             .triangle_count = 2,
                             .material = CLRT_MATERIAL_MIRROR};
    const ClrtCamera camera = {.size = sizeof camera, .eye = {3, -5, 3}, .fov_degrees = 45};
    const ClrtPicture picture = {.size = sizeof picture, .width = 320, .height = 240, .samples = 2};
    ClrtError error = {0};
    ClrtScene *scene = clrt_scene_create(&error); // or clrt_scene_load(path, NULL, &error)
    ClrtRenderer *renderer = scene == NULL ? NULL : clrt_renderer_create(NULL, &error);
    const bool ok = renderer != NULL &&
                    clrt_scene_add_sphere(scene, ball, 1, CLRT_MATERIAL_BLINN_PHONG, &error) &&
                    clrt_scene_add_mesh(scene, &ground, &error) &&
                    clrt_scene_add_light(scene, lamp, 0.9, &error) &&
                    clrt_scene_add_camera(scene, &camera, &error) &&
                    clrt_render(renderer, scene, &picture, rgb[0][0], &error);
    if (ok)
        printf("PF\n320 240\n-1.0\n");
    else
        fprintf(stderr, "%s\n", error.text);
    for (int row = 240; ok && row-- > 0;)
        fwrite(rgb[row], sizeof rgb[row], 1, stdout);
    clrt_renderer_free(renderer);
    clrt_scene_free(scene);
    return ok ? 0 : 1;
}
