// SPDX-License-Identifier: MIT
// Draws the plain picture with the kernels that clrt chooses.
#include "certainty/certified.h"

#include "accel/flat.h"
#include "extremes/support/check.h"
#include "scene/camera.h"

#include <stdlib.h>
#include <string.h>

static PictureSettings settings_of(const Scene *scene, const CertifiedView *view)
{
    PictureSettings settings = picture_settings(0);
    settings.render.width = view->width > 0 ? view->width : scene->width;
    settings.render.height = view->height > 0 ? view->height : scene->height;
    settings.render.samples = view->samples;
    settings.render.max_level = scene->max_level;
    settings.render.tile_width = settings.render.tile_height = 128;
    return settings;
}

static bool look(Certified *certified, const RendererSetup *setup, const Renderer *renderer,
                 const Normalization *normalization, Error *error)
{
    AovSet set = 0;
    AovPass pass = {0};
    Layers *seen = &certified->seen;
    const AovSource source = {.setup = setup,
                              .renderer = renderer,
                              .camera = certified->camera,
                              .center = certified->camera,
                              .scene = {normalization, certified->stage.flat.light_count}};
    if (!aov_read_list("primitive,material,shadow", &set, error))
        return false;
    aov_name_layers(set, seen);
    const bool ok =
        layers_make(seen, certified->settings.width, certified->settings.height, error) &&
        aov_pass_open(&pass, set, &source, error) && aov_pass_draw(&pass, NULL, seen, error);
    aov_pass_close(&pass);
    return ok;
}

static bool draw_plain(Certified *certified, const Studio *studio, const Scene *scene,
                       const PictureSettings *settings, Error *error)
{
    Stage stage;
    Renderer renderer;
    const RendererSetup setup = {
        .device = &studio->device, .cache = &studio->cache, .source.choice = settings->choice};
    picture_open(&renderer, &stage, studio, scene, settings);
    const bool ok = framebuffer_make(&certified->plain, settings->render.width,
                                     settings->render.height, error) &&
                    renderer_draw(&renderer, &certified->camera, NULL, &certified->plain, error) &&
                    look(certified, &setup, &renderer, &stage.normalization, error);
    renderer_close(&renderer);
    stage_free(&stage);
    return ok;
}

static bool certify(Certified *certified, const Studio *studio, Error *error)
{
    Certifier certifier = {0};
    const RenderSettings *settings = &certified->settings;
    const RendererSetup setup = {
        .device = &studio->device,
        .cache = &studio->cache,
        .source = {.kernel_folder = getenv("CLRT_KERNEL_DIR"), .choice = certifier_choice()}};
    const CertifiedPicture picture = {&certified->picture, &certified->map};
    const bool ok = certifier_open(&certifier, &setup, &certified->stage.flat, settings, error) &&
                    certainty_map_make(&certified->map, settings->width, settings->height, error) &&
                    certifier_certify(&certifier, &certified->camera, NULL, &picture, error);
    certifier_close(&certifier);
    return ok;
}

static bool copy_plain(Certified *certified, Error *error)
{
    const Framebuffer *plain = &certified->plain;
    Framebuffer *picture = &certified->picture;
    if (!framebuffer_make(picture, plain->width, plain->height, error))
        return false;
    memcpy(picture->pixels, plain->pixels, picture_pixels(plain) * sizeof *plain->pixels);
    return true;
}

Certified certified_make(const Studio *studio, const Scene *scene, const CertifiedView *view)
{
    Error error = {0};
    const PictureSettings settings = settings_of(scene, view);
    const RenderSettings *render = &settings.render;
    Certified certified = {.settings = *render};
    stage_make_as(&certified.stage, scene, TREE_SAH, NODES_PAIR);
    certified.camera =
        camera_make(&scene->viewpoints.data[view->view - 1], &certified.stage.normalization,
                    render->width, render->height, render->samples);
    require(draw_plain(&certified, studio, scene, &settings, &error) &&
                copy_plain(&certified, &error) && certify(&certified, studio, &error),
            &error);
    return certified;
}

void certified_free(Certified *certified)
{
    certainty_map_free(&certified->map);
    layers_free(&certified->seen);
    framebuffer_free(&certified->plain);
    framebuffer_free(&certified->picture);
    stage_free(&certified->stage);
}
