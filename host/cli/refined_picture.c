// SPDX-License-Identifier: MIT
// Threads of the host share what is decided between the device's passes.
#include "cli/refined_picture.h"

#include "cli/threads.h"

// Keeps how many samples each pixel has, where channels may ask for it.
static bool keep_counts(Run *run, const RefineTree *tree, Error *error)
{
    if (run->options->aovs == 0 || run->samples != NULL)
        return true;
    run->samples = memory_raw((size_t)tree->width * tree->height, sizeof *run->samples, error);
    if (run->samples == NULL)
        return false;
    for (uint32_t y = 0; y < tree->height; y++)
        for (uint32_t x = 0; x < tree->width; x++)
            run->samples[(size_t)y * tree->width + x] = refine_tree_count(tree, x, y);
    return true;
}

bool refined_picture_draw(Run *run, const CameraData *camera, const RenderObserver *observer,
                          Error *error)
{
    Adaptive adaptive;
    const float contrast = (float)run->options->contrast;
    Crew *crew = crew_open(threads_allowed(run->options->threads));
    const AdaptiveSetup setup = {&run->renderer, &run->flat, camera, crew};
    bool ok = adaptive_open(&adaptive, &setup, observer, error) &&
              adaptive_refine(&adaptive, contrast, observer, error);
    if (ok) {
        adaptive_store(&adaptive, &run->framebuffer);
        run->report.samples = adaptive.samples;
        ok = keep_counts(run, &adaptive.tree, error);
    }
    adaptive_close(&adaptive);
    crew_close(crew);
    return ok;
}
