// SPDX-License-Identifier: MIT
// Chooses the kernels of channels and certainty.
#include "session/channels.h"

bool session_certify(Session *session, const SessionPicture *request,
                     const RenderObserver *observer, Framebuffer *framebuffer,
                     PictureResult *result, Error *error)
{
    Renderer renderer;
    const KernelChoice exact = session_exact_choice();
    const RendererUse use = {.entry = &certify_entry, .choice = &exact, .is_general = true};
    const CameraData camera = session_camera(session, request, request->settings.samples);
    const CertifiedPicture picture = {framebuffer, &result->certainty};
    if (!aov_needs(request->channels, AOV_NEEDS_CERTAINTY))
        return true;
    return certifier_check_device(&session->device, error) &&
           certainty_map_make(&result->certainty, framebuffer->width, framebuffer->height, error) &&
           session_renderer(session, &use, &request->settings, &renderer, error) &&
           certifier_certify(&renderer, &camera, observer, &picture, error);
}

bool session_draw_channels(Session *session, const SessionPicture *request,
                           const RenderObserver *observer, Layers *layers,
                           const PictureResult *result, Error *error)
{
    const bool counts = aov_needs(request->channels, AOV_NEEDS_TESTS);
    const RendererUse paths = {.entry = &paths_entry, .counts = counts, .is_general = true};
    const RendererUse tests = {.entry = &tests_entry, .counts = true, .is_general = true};
    const SessionScene *scene = &session->scene;
    AovPass pass = {.set = request->channels,
                    .camera = session_camera(session, request, request->settings.samples),
                    .center = session_camera(session, request, 1),
                    .samples = result->pixel_samples,
                    .scene = {&scene->normalization, (uint32_t)scene->scene->lights.count},
                    .certainty = result->certainty.marks != NULL ? &result->certainty : NULL};
    if (!session_renderer(session, &paths, &request->settings, &pass.paths, error))
        return false;
    SceneTraits traits = pass.paths.scene->traits;
    traits.statistics = true;
    traits = traits_general(traits);
    if (counts)
        pass.tests = session_kernel(session, &tests, &traits, error);
    return (!counts || pass.tests != NULL) && aov_pass_draw(&pass, observer, layers, error);
}
