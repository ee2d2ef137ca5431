// SPDX-License-Identifier: MIT
// Draws the plain picture with the kernels that clrt chooses, then certifies a copy of it.
#include "certainty/certified.h"

#include "extremes/support/check.h"
#include "image/rendered.h"
#include "image/shared_cache.h"
#include "scene/camera.h"

#include <stdlib.h>
#include <string.h>

static const Studio *studio;

static int keep_studio(void **state)
{
    studio = *state;
    return 0;
}

FIXTURES(picture_setup, picture_teardown)
AT_START(studio)
{
    test_set_up(keep_studio);
}

static void draw_plain(Certified *certified, const Scene *scene, const CertifiedView *view)
{
    PictureRequest request = picture_request(NULL, view->view);
    request.scene = scene;
    request.width = certified->settings.width;
    request.height = certified->settings.height;
    request.samples = view->samples;
    certified->plain = rendered_with(request, "primitive,material,shadow", &certified->seen);
}

static bool certify(Certified *certified, Error *error)
{
    SceneBuffers buffers = {0};
    const RenderSettings *settings = &certified->settings;
    const KernelSpec spec = {.entry = &certify_entry,
                             .choice = {FAMILY_RAY, NODES_PAIR, 0, CLRT_FP64},
                             .traits = traits_general(traits_of(&certified->stage.flat, false))};
    KernelSet kernels = {.source = {.device = &studio->device,
                                    .cache = shared_cache(),
                                    .kernel_folder = getenv("CLRT_KERNEL_DIR")}};
    const CertifiedPicture picture = {&certified->picture, &certified->map};
    Renderer renderer = {.scene = &buffers, .settings = *settings};
    bool ok = certifier_check_device(&studio->device, error) &&
              scene_buffers_make(&buffers, &studio->device, &certified->stage.flat, error) &&
              certainty_map_make(&certified->map, settings->width, settings->height, error);
    renderer.kernel = ok ? kernel_set_get(&kernels, &spec, error) : NULL;
    ok = renderer.kernel != NULL &&
         certifier_certify(&renderer, &certified->camera, NULL, &picture, error);
    scene_buffers_free(&buffers);
    kernel_set_clear(&kernels);
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

Certified certified_make(const Scene *scene, const CertifiedView *view)
{
    Error error = {0};
    Certified certified = {.settings = picture_settings(view->width).render};
    RenderSettings *settings = &certified.settings;
    settings->height = view->height;
    settings->samples = view->samples;
    settings->max_level = scene->max_level;
    stage_make_as(&certified.stage, scene, view->tree, NODES_PAIR);
    certified.camera =
        camera_make(&scene->viewpoints.data[view->view - 1], &certified.stage.normalization,
                    settings->width, settings->height, settings->samples);
    draw_plain(&certified, scene, view);
    require(copy_plain(&certified, &error) && certify(&certified, &error), &error);
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
