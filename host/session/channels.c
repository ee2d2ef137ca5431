// SPDX-License-Identifier: MIT
// Chooses the kernels of channels and certainty.
#include "session/channels.h"

bool session_certify(Session *session, const SessionPicture *request,
                     const RenderObserver *observer, const CertifiedPicture *picture, Error *error)
{
    Renderer renderer;
    const KernelChoice exact = session_exact_choice();
    const RendererUse use = {.entry = &certify_entry, .choice = &exact, .is_general = true};
    const CameraData camera = session_camera(session, request, request->settings.samples);
    return certifier_check_device(&session->device, error) &&
           session_renderer(session, &use, &request->settings, &renderer, error) &&
           certifier_certify(&renderer, &camera, observer, picture, error);
}

bool session_draw_channels(Session *session, const SessionPicture *request,
                           const ChannelRequest *channels, const RenderObserver *observer,
                           Layers *layers, Error *error)
{
    const bool counts = aov_needs(channels->set, AOV_NEEDS_TESTS);
    const RendererUse paths = {.entry = &paths_entry, .counts = counts, .is_general = true};
    const RendererUse tests = {.entry = &tests_entry, .counts = true, .is_general = true};
    const SessionScene *scene = &session->scene;
    AovPass pass = {.set = channels->set,
                    .camera = session_camera(session, request, request->settings.samples),
                    .center = session_camera(session, request, 1),
                    .samples = channels->pixel_samples,
                    .scene = {&scene->normalization, (uint32_t)scene->scene->lights.count},
                    .certainty = channels->certainty};
    if (!session_renderer(session, &paths, &request->settings, &pass.paths, error))
        return false;
    SceneTraits traits = pass.paths.scene->traits;
    traits.statistics = true;
    traits = traits_general(traits);
    if (counts)
        pass.tests = session_kernel(session, &tests, &traits, error);
    return (!counts || pass.tests != NULL) && aov_pass_draw(&pass, observer, layers, error);
}
