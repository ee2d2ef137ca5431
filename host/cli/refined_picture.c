// SPDX-License-Identifier: MIT
// Threads of the host share what is decided between the device's passes.
#include "cli/refined_picture.h"

#include "cli/threads.h"

bool refined_picture_draw(Run *run, const CameraData *camera, const RenderObserver *observer,
                          Error *error)
{
    Adaptive adaptive;
    const float contrast = (float)run->options->contrast;
    Crew *crew = crew_open(threads_allowed(run->options->threads));
    const AdaptiveSetup setup = {&run->renderer, &run->flat, camera, crew};
    const bool ok = adaptive_open(&adaptive, &setup, observer, error) &&
                    adaptive_refine(&adaptive, contrast, observer, error);
    if (ok) {
        adaptive_store(&adaptive, &run->framebuffer);
        run->report.samples = adaptive.samples;
    }
    adaptive_close(&adaptive);
    crew_close(crew);
    return ok;
}
