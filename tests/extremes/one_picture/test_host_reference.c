// SPDX-License-Identifier: MIT
// The device's picture is, bit by bit, that of the same kernels compiled for the host by clang.
#include "host_kernel.h"
#include "support/check.h"
#include "support/picture.h"
#include "support/report.h"
#include "support/tier.h"
#include "support/tree_scenes.h"
#include "support/varied_scene.h"

static void add_view_and_light(Scene *scene)
{
    Error error = {0};
    const Light light = light_white(vec3(6, -5, 9), 1);
    const Viewpoint viewpoint = {{1, -4, 2}, {0, 0, 0}, {0, 0, 1}, 40, 0};
    require(array_push(&scene->lights, light, &error) &&
                array_push(&scene->viewpoints, viewpoint, &error),
            &error);
}

// How many pixels the device, with the form under test, draws otherwise than the host.
static size_t count_differences(const Studio *studio, const Scene *scene)
{
    Stage stage;
    Renderer renderer;
    Error error = {0};
    Framebuffer device, host;
    PictureSettings settings = picture_settings();
    settings.render.samples = 2;
    settings.render.width = settings.render.height = (uint32_t)tier_size(64, 256);
    picture_draw(&device, studio, scene, &settings);
    settings.choice = (KernelChoice){FAMILY_RAY, NODES_PAIR, 0, PRECISION_FP32};
    settings.render.group_width = settings.render.group_height = 8;
    picture_open(&renderer, &stage, studio, scene, &settings);
    FrameData frame = renderer.frame;
    frame.camera = picture_camera(scene, &settings.render);
    require(framebuffer_make(&host, device.width, device.height, &error), &error);
    host_kernel_draw(&frame, &stage.flat, &host);
    const size_t differences = picture_count_differences(&device, &host);
    renderer_close(&renderer);
    stage_free(&stage);
    framebuffer_free(&device);
    framebuffer_free(&host);
    return differences;
}

static size_t judge(const Studio *studio, const char *name, Scene scene)
{
    char details[48];
    const size_t side = tier_size(64, 256);
    snprintf(details, sizeof details, "scene=%s", name);
    const size_t differences =
        report_case("T-51", details, side * side, count_differences(studio, &scene));
    scene_free(&scene);
    return differences;
}

static void the_host_draws_the_devices_picture_bit_by_bit_t51(void **state)
{
    size_t differences = judge(*state, "varied", varied_scene());
    for (size_t number = 0; number < TREE_SCENES; number++) {
        Scene scene = tree_scene_make(number);
        add_view_and_light(&scene);
        differences += judge(*state, tree_scenes[number].name, scene);
    }
    assert_int_equal(differences, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_host_draws_the_devices_picture_bit_by_bit_t51),
    };
    return cmocka_run_group_tests(tests, picture_setup, picture_teardown);
}
