// SPDX-License-Identifier: MIT
// Draws the plain picture with packets, as clrt does on CPUs.
#include "certainty/certified.h"

#include "accel/flat.h"
#include "scene/camera.h"

#include <stdlib.h>
#include <string.h>

bool office_open(Office *office, Error *error)
{
    *office = (Office){0};
    cache_open(&office->cache);
    return device_open(&office->device, getenv("CLRT_DEVICE"), error);
}

void office_close(Office *office)
{
    device_close(&office->device);
    cache_close(&office->cache);
}

static bool flatten(FlatScene *flat, const Scene *scene, NodeLayout layout, Error *error)
{
    const Normalization normalization = normalization_of(scene);
    const CompileSource source = {.scene = scene,
                                  .normalization = &normalization,
                                  .layout = layout,
                                  .builder = BVH_SAH,
                                  .has_tree = true};
    return normalization_check(&normalization, scene, error) &&
           scene_compile(flat, NULL, &source, error);
}

static RenderSettings settings_of(const Scene *scene, const CertifiedView *view)
{
    return (RenderSettings){.width = view->width > 0 ? view->width : scene->width,
                            .height = view->height > 0 ? view->height : scene->height,
                            .samples = view->samples,
                            .max_level = scene->max_level,
                            .tile_width = 128,
                            .tile_height = 128,
                            .specialization = SPECIALIZE_NEVER};
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
                              .scene = {normalization, certified->flat.light_count}};
    if (!aov_read_list("primitive,material,shadow", &set, error))
        return false;
    aov_name_layers(set, seen);
    const bool ok =
        layers_make(seen, certified->settings.width, certified->settings.height, error) &&
        aov_pass_open(&pass, set, &source, error) && aov_pass_draw(&pass, NULL, seen, error);
    aov_pass_close(&pass);
    return ok;
}

static bool draw_plain(Certified *certified, const Office *office, const Scene *scene, Error *error)
{
    const KernelRequest nothing = {0};
    RendererSetup setup = {.device = &office->device, .cache = &office->cache};
    setup.source.choice = kernel_choose(&nothing, &office->device);
    RenderSettings settings = certified->settings;
    settings.group_width = settings.group_height = kernel_group_side(&setup.source.choice);
    FlatScene flat = {0};
    Renderer renderer = {0};
    const Normalization normalization = normalization_of(scene);
    const bool ok = flatten(&flat, scene, setup.source.choice.nodes, error) &&
                    renderer_open(&renderer, &setup, &flat, &settings, error) &&
                    framebuffer_make(&certified->plain, settings.width, settings.height, error) &&
                    renderer_draw(&renderer, &certified->camera, NULL, &certified->plain, error) &&
                    look(certified, &setup, &renderer, &normalization, error);
    renderer_close(&renderer);
    flat_free(&flat);
    return ok;
}

static bool certify(Certified *certified, const Office *office, Error *error)
{
    Certifier certifier = {0};
    const RenderSettings *settings = &certified->settings;
    const RendererSetup setup = {
        .device = &office->device,
        .cache = &office->cache,
        .source = {.kernel_folder = getenv("CLRT_KERNEL_DIR"), .choice = certifier_choice()}};
    const CertifiedPicture picture = {&certified->picture, &certified->map};
    const bool ok = certifier_open(&certifier, &setup, &certified->flat, settings, error) &&
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
    memcpy(picture->pixels, plain->pixels,
           (size_t)plain->width * plain->height * sizeof *plain->pixels);
    return true;
}

bool certified_make(Certified *certified, const Office *office, const Scene *scene,
                    const CertifiedView *view, Error *error)
{
    const Normalization normalization = normalization_of(scene);
    const RenderSettings settings = settings_of(scene, view);
    *certified = (Certified){.settings = settings};
    certified->camera = camera_make(&scene->viewpoints.data[view->view - 1], &normalization,
                                    settings.width, settings.height, settings.samples);
    return flatten(&certified->flat, scene, NODES_PAIR, error) &&
           draw_plain(certified, office, scene, error) && copy_plain(certified, error) &&
           certify(certified, office, error);
}

void certified_free(Certified *certified)
{
    certainty_map_free(&certified->map);
    layers_free(&certified->seen);
    framebuffer_free(&certified->plain);
    framebuffer_free(&certified->picture);
    flat_free(&certified->flat);
    *certified = (Certified){0};
}
