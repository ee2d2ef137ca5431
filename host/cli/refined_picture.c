// SPDX-License-Identifier: MIT
// The device traces samples in passes. Between passes, a thread pool on the host decides where to
// sample next.
#include "cli/picture.h"

#include "accel/flat.h"
#include "base/clock.h"
#include "cli/process.h"
#include "device/device.h"
#include "refine/adaptive.h"
#include "refine/ladder.h"
#include "render/certifier.h"

#include <math.h>
#include <string.h>

// Returns the error that sampling may add to the truncation error; negative if truncation alone
// reaches the goal.
static double error_left(const Run *run)
{
    const double most = run->options->error_goal, truncation = report_counted_truncation(run);
    return truncation < most ? sqrt(most * most - truncation * truncation) : -1;
}

static bool keep_counts(Picture *picture, Error *error)
{
    Run *run = picture->run;
    const size_t pixels = (size_t)picture->framebuffer.width * picture->framebuffer.height;
    if (run->options->aovs == 0 || picture->samples != NULL)
        return true;
    picture->samples = memory_raw(pixels, sizeof *picture->samples, error);
    return picture->samples != NULL;
}

static void count_tree(Picture *picture, const RefineTree *tree)
{
    if (picture->samples == NULL)
        return;
    for (uint32_t y = 0; y < tree->height; y++)
        for (uint32_t x = 0; x < tree->width; x++)
            picture->samples[(size_t)y * tree->width + x] = refine_tree_count(tree, x, y);
}

static bool draw_adaptively(Picture *picture, const CameraData *camera, ThreadPool *pool,
                            const RenderObserver *observer, Error *error)
{
    Run *run = picture->run;
    Adaptive adaptive;
    const AdaptiveSetup setup = {&run->renderer, &run->flat,  camera,
                                 pool,           &run->scene, &run->normalization};
    const bool ok = adaptive_open(&adaptive, &setup, observer, error) &&
                    adaptive_refine(&adaptive, (float)run->options->contrast, observer, error);
    if (ok) {
        adaptive_store(&adaptive, &picture->framebuffer);
        count_tree(picture, &adaptive.tree);
    }
    run->report.samples = adaptive.samples;
    adaptive_close(&adaptive);
    return ok;
}

// Refines toward the time or error goal. Does nothing if truncation alone reaches the error goal.
static bool refine(const Run *run, Ladder *ladder, double start, GoalOutcome *outcome, Error *error)
{
    const GoalTime time = {start, run->options->time_goal};
    if (run->options->time_goal > 0)
        return goal_spend_time(ladder, &time, outcome, error);
    return error_left(run) <= 0 || goal_reach_error(ladder, error_left(run), outcome, error);
}

static bool draw_for_goal(Picture *picture, const CameraData *camera, ThreadPool *pool,
                          const RenderObserver *observer, Error *error)
{
    Run *run = picture->run;
    Ladder ladder;
    GoalOutcome outcome = {0};
    Report *report = &run->report;
    const double start = clock_seconds();
    const LadderSetup setup = {
        &run->renderer,        &run->flat, camera, pool, &run->scene, &run->normalization,
        &picture->framebuffer, observer};
    if (!ladder_open(&ladder, &setup, error))
        return false;
    const bool ok = refine(run, &ladder, start, &outcome, error);
    report->estimate = hypot(outcome.estimate, report_counted_truncation(run));
    report->bound = hypot(outcome.bound, report_counted_truncation(run));
    report->goal_missed = !outcome.reached;
    report->samples = ladder.samples;
    for (size_t pixel = 0; picture->samples != NULL && pixel < ladder.statistics.pixels; pixel++)
        picture->samples[pixel] = ladder_pixel_samples(&ladder, pixel);
    ladder_close(&ladder);
    return ok;
}

bool refined_picture_draw(Picture *picture, const CameraData *camera,
                          const RenderObserver *observer, Error *error)
{
    Run *run = picture->run;
    if (!keep_counts(picture, error))
        return false;
    ThreadPool *pool = thread_pool_open(threads_allowed(run->options->threads));
    const bool ok = run->options->contrast > 0
                        ? draw_adaptively(picture, camera, pool, observer, error)
                        : draw_for_goal(picture, camera, pool, observer, error);
    thread_pool_close(pool);
    return ok;
}

static bool certify(Picture *picture, const CameraData *camera, Error *error)
{
    Run *run = picture->run;
    Certifier certifier;
    RendererSetup setup = run->async_device.setup;
    setup.source.choice = certifier_choice();
    const FlatScene *flat = run_compiled_scene(run, setup.source.choice.nodes, error);
    if (flat == NULL || !certifier_open(&certifier, &setup, flat, &run->settings, error))
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
    double moment = clock_seconds();
    const Framebuffer *frame = &picture->framebuffer;
    if (!certainty_map_make(&picture->certainty, frame->width, frame->height, error))
        return false;
    if (picture->stopped_by != 0)
        return true;
    const bool ok = certify(picture, camera, error);
    run->report.complete = run->report.complete && picture->stopped_by == 0;
    run->report.certainty.seconds = run_lap(&moment);
    memcpy(run->report.certainty.pixels, picture->certainty.counts,
           sizeof picture->certainty.counts);
    return ok;
}
