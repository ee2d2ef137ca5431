// SPDX-License-Identifier: MIT
// The stages of the program's main, from a Scene on.
#include "picture.h"

#include "check.h"
#include "image/form.h"
#include "scene/camera.h"

#include <stdlib.h>
#include <string.h>

int picture_setup(void **state)
{
    static Studio studio;
    Error error = {0};
    cache_open(&studio.cache);
    require(device_open(&studio.device, getenv("CLRT_DEVICE"), &error), &error);
    *state = &studio;
    return 0;
}

int picture_teardown(void **state)
{
    Studio *studio = *state;
    device_close(&studio->device);
    cache_close(&studio->cache);
    return 0;
}

PictureSettings picture_settings(void)
{
    const KernelChoice choice = form_choice();
    const uint32_t group = form_group(&choice);
    return (PictureSettings){.tree = TREE_SAH,
                             .choice = choice,
                             .render = {.width = 64,
                                        .height = 64,
                                        .samples = 1,
                                        .max_level = 4,
                                        .tile_width = 32,
                                        .tile_height = 32,
                                        .group_width = group,
                                        .group_height = group,
                                        .specialization = SPECIALIZE_NEVER}};
}

void picture_open(Renderer *renderer, Stage *stage, const Studio *studio, const Scene *scene,
                  const PictureSettings *settings)
{
    Error error = {0};
    const RendererSetup setup = {.device = &studio->device,
                                 .cache = &studio->cache,
                                 .source = {.kernel_folder = getenv("CLRT_KERNEL_DIR"),
                                            .extra_options = settings->extra_options,
                                            .choice = settings->choice}};
    stage_make_as(stage, scene, settings->tree, settings->choice.nodes);
    const bool ok = renderer_open(renderer, &setup, &stage->flat, &settings->render, &error);
    if (!ok)
        stage_free(stage);
    require(ok, &error);
}

CameraData picture_camera(const Scene *scene, const RenderSettings *settings)
{
    const Normalization normalization = normalization_of(scene);
    return camera_make(&scene->viewpoints.data[0], &normalization, settings->width,
                       settings->height, settings->samples);
}

void picture_draw(Framebuffer *framebuffer, const Studio *studio, const Scene *scene,
                  const PictureSettings *settings)
{
    RenderProgress progress;
    picture_draw_counted(framebuffer, studio, scene, settings, &progress);
}

void picture_draw_counted(Framebuffer *framebuffer, const Studio *studio, const Scene *scene,
                          const PictureSettings *settings, RenderProgress *progress)
{
    Stage stage;
    Renderer renderer;
    Error error = {0};
    const RenderSettings *render = &settings->render;
    const CameraData camera = picture_camera(scene, render);
    picture_open(&renderer, &stage, studio, scene, settings);
    const bool ok = framebuffer_make(framebuffer, render->width, render->height, &error) &&
                    renderer_draw(&renderer, &camera, NULL, framebuffer, &error);
    *progress = renderer.progress;
    renderer_close(&renderer);
    stage_free(&stage);
    require(ok, &error);
}

size_t picture_count_differences(const Framebuffer *a, const Framebuffer *b)
{
    size_t count = 0;
    assert_int_equal(a->width, b->width);
    assert_int_equal(a->height, b->height);
    for (size_t pixel = 0; pixel < (size_t)a->width * a->height; pixel++)
        count += memcmp(a->pixels[pixel], b->pixels[pixel], sizeof a->pixels[pixel]) != 0;
    return count;
}

size_t picture_count_faults(const Framebuffer *framebuffer)
{
    size_t count = 0;
    for (size_t pixel = 0; pixel < (size_t)framebuffer->width * framebuffer->height; pixel++) {
        bool valid = true;
        for (int channel = 0; channel < 3; channel++) {
            const float value = framebuffer->pixels[pixel][channel];
            valid = valid && value >= 0 && value <= 1;
        }
        count += !valid;
    }
    return count;
}

size_t picture_count_covered(const Framebuffer *framebuffer)
{
    size_t count = 0;
    const float(*pixels)[3] = (const float(*)[3])framebuffer->pixels;
    for (size_t pixel = 0; pixel < (size_t)framebuffer->width * framebuffer->height; pixel++)
        count += memcmp(pixels[pixel], pixels[0], sizeof *pixels) != 0;
    return count;
}
