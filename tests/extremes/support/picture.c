// SPDX-License-Identifier: MIT
// Draws a Scene by the stages of the program. Compares pictures with the oracle's by
// tests/image/comparison.h.
#include "picture.h"

#include "image/comparison.h"
#include "image/form.h"
#include "image/shared_cache.h"
#include "scene/camera.h"

#include <string.h>

int picture_setup(void **state)
{
    static Studio studio;
    Error error = {0};
    shared_cache();
    require(device_open(&studio.device, getenv("CLRT_DEVICE"), &error), &error);
    *state = &studio;
    return 0;
}

int picture_teardown(void **state)
{
    Studio *studio = *state;
    device_close(&studio->device);
    return 0;
}

PictureSettings picture_settings(uint32_t side)
{
    const KernelChoice choice = form_choice();
    return (PictureSettings){.tree = TREE_SAH,
                             .choice = choice,
                             .render = {.width = side,
                                        .height = side,
                                        .samples = 1,
                                        .max_level = 4,
                                        .tile_width = 32,
                                        .tile_height = 32}};
}

void picture_open(OpenPicture *picture, const Studio *studio, const Scene *scene,
                  const PictureSettings *settings)
{
    Error error = {0};
    *picture = (OpenPicture){.kernels.source = {.device = &studio->device,
                                                .cache = shared_cache(),
                                                .kernel_folder = getenv("CLRT_KERNEL_DIR"),
                                                .extra_options = settings->extra_options}};
    stage_make_as(&picture->stage, scene, settings->tree, settings->choice.nodes);
    const bool ok =
        scene_buffers_make(&picture->buffers, &studio->device, &picture->stage.flat, &error);
    const KernelSpec spec = {.entry = &draw_entry,
                             .choice = settings->choice,
                             .traits = traits_general(picture->buffers.traits)};
    picture->renderer =
        (Renderer){.kernel = ok ? kernel_set_get(&picture->kernels, &spec, &error) : NULL,
                   .scene = &picture->buffers,
                   .settings = settings->render};
    if (picture->renderer.kernel == NULL)
        picture_close(picture);
    require(error.text[0] == '\0', &error);
}

// Frees the buffers before the stage, because the device may share the stage's memory.
void picture_close(OpenPicture *picture)
{
    scene_buffers_free(&picture->buffers);
    kernel_set_clear(&picture->kernels);
    stage_free(&picture->stage);
}

CameraData picture_camera(const Scene *scene, const RenderSettings *settings)
{
    const Normalization normalization = normalization_of(scene);
    return camera_make(&scene->viewpoints.data[0], &normalization, settings->width,
                       settings->height, settings->samples);
}

Framebuffer picture_draw(const Studio *studio, const Scene *scene, const PictureSettings *settings)
{
    OpenPicture open;
    Error error = {0};
    Framebuffer picture;
    const RenderSettings *render = &settings->render;
    const CameraData camera = picture_camera(scene, render);
    picture_open(&open, studio, scene, settings);
    const bool ok = framebuffer_make(&picture, render->width, render->height, &error) &&
                    tile_pass_draw(&open.renderer, &camera, NULL, &picture, &error);
    picture_close(&open);
    require(ok, &error);
    return picture;
}

Framebuffer picture_draw_once(const Studio *studio, Scene scene, const PictureSettings *settings)
{
    const Framebuffer picture = picture_draw(studio, &scene, settings);
    scene_free(&scene);
    return picture;
}

size_t picture_pixels(const Framebuffer *picture)
{
    return (size_t)picture->width * picture->height;
}

Outcome picture_compare(const char *test, const Framebuffer *usual, Framebuffer other)
{
    Outcome outcome = {.test = test, .count = picture_pixels(usual)};
    assert_int_equal(usual->width, other.width);
    assert_int_equal(usual->height, other.height);
    for (size_t i = 0; i < outcome.count; i++)
        outcome.failures[BY_CLRT] +=
            memcmp(usual->pixels[i], other.pixels[i], sizeof *other.pixels) != 0;
    framebuffer_free(&other);
    return outcome;
}

Outcome picture_judge(const char *test, const Studio *studio, Scene scene,
                      const PictureSettings *settings)
{
    return picture_judge_beside(test, studio, scene, scene, settings);
}

Outcome picture_judge_beside(const char *test, const Studio *studio, Scene scene, Scene exact,
                             const PictureSettings *settings)
{
    Error error = {0};
    Oracle oracle;
    Framebuffer expected;
    const RenderSettings *render = &settings->render;
    require(oracle_make(&oracle, &exact, &error), &error);
    const OracleView view = oracle_view(&oracle, &exact.viewpoints.data[0], render->width,
                                        render->height, render->max_level);
    Framebuffer picture = picture_draw(studio, &scene, settings);
    require(oracle_draw(&view, render->samples, 1, &expected, &error), &error);
    const Comparison comparison = comparison_make(&view, &picture, &expected, 1);
    const size_t failures = comparison.unexplained + picture_count_faults(&picture);
    const Outcome outcome = outcome_of(test, picture_pixels(&picture), failures);
    if (comparison.unexplained > 0)
        comparison_print(&comparison, "oracle");
    framebuffer_free(&picture);
    framebuffer_free(&expected);
    oracle_free(&oracle);
    if (exact.lights.data != scene.lights.data)
        scene_free(&exact);
    scene_free(&scene);
    return outcome;
}

size_t picture_count_faults(const Framebuffer *picture)
{
    size_t count = 0;
    const float *values = *picture->pixels;
    for (size_t i = 0; i < 3 * picture_pixels(picture); i++)
        count += !(values[i] >= 0 && values[i] <= 1);
    return count;
}

size_t picture_count_other(const Framebuffer *picture, const float color[3])
{
    size_t count = 0;
    for (size_t i = 0; i < picture_pixels(picture); i++)
        count += memcmp(picture->pixels[i], color, sizeof *picture->pixels) != 0;
    return count;
}
