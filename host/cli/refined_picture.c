// SPDX-License-Identifier: MIT
// The device traces samples in passes. Between passes, a thread pool on the host decides where to
// sample next.
#include "cli/refined_picture.h"

#include "base/clock.h"
#include "device/threads.h"
#include "refine/adaptive.h"
#include "refine/goal.h"

#include <math.h>
#include <stdio.h>

// Returns the truncation error that counts toward --error. It is 0 if the scene or --max-level sets
// the number of levels.
static double truncation_of(const Run *run)
{
    const Options *options = run->options;
    return options->error_goal > 0 && options->max_level < 0 ? run->report.truncation : 0;
}

// Returns the error that sampling may add to the truncation error; negative if truncation alone
// exceeds the goal.
static double error_left(const Run *run)
{
    const double most = run->options->error_goal, truncation = truncation_of(run);
    return truncation < most ? sqrt(most * most - truncation * truncation) : -1;
}

// Allocates run->samples if the options select channels.
static bool keep_counts(Run *run, Error *error)
{
    const size_t pixels = (size_t)run->framebuffer.width * run->framebuffer.height;
    if (run->options->aovs == 0 || run->samples != NULL)
        return true;
    run->samples = memory_raw(pixels, sizeof *run->samples, error);
    return run->samples != NULL;
}

static void count_tree(Run *run, const RefineTree *tree)
{
    if (run->samples == NULL)
        return;
    for (uint32_t y = 0; y < tree->height; y++)
        for (uint32_t x = 0; x < tree->width; x++)
            run->samples[(size_t)y * tree->width + x] = refine_tree_count(tree, x, y);
}

static bool draw_adaptively(Run *run, const CameraData *camera, Crew *crew,
                            const RenderObserver *observer, Error *error)
{
    Adaptive adaptive;
    const AdaptiveSetup setup = {&run->renderer, &run->flat,  camera,
                                 crew,           &run->scene, &run->normalization};
    const bool ok = adaptive_open(&adaptive, &setup, observer, error) &&
                    adaptive_refine(&adaptive, (float)run->options->contrast, observer, error);
    if (ok) {
        adaptive_store(&adaptive, &run->framebuffer);
        count_tree(run, &adaptive.tree);
    }
    run->report.contrast = run->options->contrast;
    run->report.samples = adaptive.samples;
    adaptive_close(&adaptive);
    return ok;
}

// Refines until the time or error goal is met. Does nothing if truncation alone exceeds the error
// goal.
static bool refine(const Run *run, Ladder *ladder, double start, GoalOutcome *outcome, Error *error)
{
    const GoalTime time = {start, run->options->time_goal};
    if (run->options->time_goal > 0)
        return goal_spend_time(ladder, &time, outcome, error);
    return error_left(run) <= 0 || goal_reach_error(ladder, error_left(run), outcome, error);
}

static bool draw_for_goal(Run *run, const CameraData *camera, Crew *crew,
                          const RenderObserver *observer, Error *error)
{
    Ladder ladder;
    GoalOutcome outcome = {0};
    Report *report = &run->report;
    const double start = clock_seconds();
    const LadderSetup setup = {&run->renderer, camera, crew, &run->framebuffer, observer};
    if (!ladder_open(&ladder, &setup, error))
        return false;
    const bool ok = refine(run, &ladder, start, &outcome, error);
    report->estimate = hypot(outcome.estimate, truncation_of(run));
    report->bound = hypot(outcome.bound, truncation_of(run));
    report->goal_missed = !outcome.reached;
    report->samples = ladder.samples;
    for (size_t pixel = 0; run->samples != NULL && pixel < ladder.statistics.pixels; pixel++)
        run->samples[pixel] = ladder_pixel_samples(&ladder, pixel);
    ladder_close(&ladder);
    return ok;
}

bool refined_picture_draw(Run *run, const CameraData *camera, const RenderObserver *observer,
                          Error *error)
{
    if (!keep_counts(run, error))
        return false;
    Crew *crew = crew_open(threads_allowed(run->options->threads));
    const bool ok = run->options->contrast > 0 ? draw_adaptively(run, camera, crew, observer, error)
                                               : draw_for_goal(run, camera, crew, observer, error);
    crew_close(crew);
    return ok;
}
