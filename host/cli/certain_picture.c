// SPDX-License-Identifier: MIT
// Certifies the pixels of a drawn picture. The certifier needs pair nodes, so the scene is
// flattened again.
#include "cli/picture.h"

#include "accel/flat.h"
#include "base/clock.h"
#include "device/device.h"
#include "render/certifier.h"

#include <string.h>

static bool flatten(const Run *run, FlatScene *flat, Error *error)
{
    const CompileSource source = {.scene = &run->scene,
                                  .normalization = &run->normalization,
                                  .layout = certifier_choice().nodes,
                                  .builder = run->options->builder,
                                  .has_tree = true,
                                  .pool = thread_pool_open(threads_allowed(run->options->threads))};
    const bool ok = scene_compile(flat, NULL, &source, error);
    thread_pool_close(source.pool);
    return ok;
}

static bool certify(Picture *picture, const CameraData *camera, const FlatScene *flat, Error *error)
{
    Run *run = picture->run;
    Certifier certifier;
    RendererSetup setup = run->async_device.setup;
    setup.source.choice = certifier_choice();
    if (!certifier_open(&certifier, &setup, flat, &run->settings, error))
        return false;
    Progress progress = progress_begin(run->options->quiet);
    const RenderObserver observer = {progress_tile_done, &progress};
    const CertifiedPicture certified = {&picture->framebuffer, &picture->certainty};
    const bool ok = certifier_certify(&certifier, camera, &observer, &certified, error);
    picture->stopped_by = progress_end(&progress);
    certifier_close(&certifier);
    return ok;
}

bool certain_picture_make(Picture *picture, const CameraData *camera, Error *error)
{
    Run *run = picture->run;
    FlatScene flat = {0};
    double moment = clock_seconds();
    const RenderSettings *settings = &run->settings;
    if (!certainty_map_make(&picture->certainty, settings->width, settings->height, error))
        return false;
    if (picture->stopped_by != 0)
        return true;
    const bool ok = flatten(run, &flat, error) && certify(picture, camera, &flat, error);
    flat_free(&flat);
    run->report.complete = run->report.complete && picture->stopped_by == 0;
    run->report.certainty.seconds = run_lap(&moment);
    memcpy(run->report.certainty.pixels, picture->certainty.counts,
           sizeof picture->certainty.counts);
    return ok;
}
