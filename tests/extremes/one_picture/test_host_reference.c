// SPDX-License-Identifier: MIT
// The device draws the same bits as the same kernels compiled for the host by clang.
#include "host_kernel.h"
#include "support/tree_scenes.h"
#include "support/varied_scene.h"

static Scene visible_scene(size_t number)
{
    Error error = {0};
    const Viewpoint viewpoint = {{1, -4, 2}, {0, 0, 0}, {0, 0, 1}, 40, 0};
    Scene scene = tree_scene_make(number);
    require(array_push(&scene.lights, light_white(vec3(6, -5, 9), 1), &error) &&
                array_push(&scene.viewpoints, viewpoint, &error),
            &error);
    return scene;
}

static Framebuffer draw_on_host(const Studio *studio, const Scene *scene, PictureSettings settings)
{
    Stage stage;
    Renderer renderer;
    Error error = {0};
    Framebuffer picture;
    settings.choice = (KernelChoice){FAMILY_RAY, NODES_PAIR, 0, PRECISION_FP32};
    settings.render.group_width = settings.render.group_height = 8;
    picture_open(&renderer, &stage, studio, scene, &settings);
    FrameData frame = renderer.frame;
    frame.camera = picture_camera(scene, &settings.render);
    require(framebuffer_make(&picture, settings.render.width, settings.render.height, &error),
            &error);
    host_kernel_draw(&frame, &stage.flat, &picture);
    renderer_close(&renderer);
    stage_free(&stage);
    return picture;
}

// Frees the scene.
static void judge(const Studio *studio, const char *name, Scene scene)
{
    PictureSettings settings = picture_settings((uint32_t)tier_size(64, 256));
    settings.render.samples = 2;
    Framebuffer host = draw_on_host(studio, &scene, settings);
    const Framebuffer device = picture_draw_once(studio, scene, &settings);
    outcome_report(picture_compare("T-51", &host, device), "scene=%s", name);
    framebuffer_free(&host);
}

static void the_host_draws_the_devices_picture_bit_by_bit_t51(void **state)
{
    judge(*state, "varied", varied_scene());
    for (size_t number = 0; number < TREE_SCENES; number++)
        judge(*state, tree_scene_names[number], visible_scene(number));
}

RUN_TESTS(picture_setup, picture_teardown,
          EXTREME(the_host_draws_the_devices_picture_bit_by_bit_t51))
