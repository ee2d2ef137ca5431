// SPDX-License-Identifier: MIT
// Threads of the host share what is decided between the device's passes.
#include "cli/refined_picture.h"

#include "base/clock.h"
#include "cli/threads.h"
#include "render/goal.h"

#include <math.h>
#include <stdio.h>

// Whoever names the levels of reflections asks for the picture that they make.
static double truncation_of(const Run *run)
{
    return run->options->max_level >= 0 ? 0 : run->report.truncation;
}

// The error that sampling may make beside the truncation's; below 0 where that alone is too much.
static double error_left(const Run *run)
{
    const double most = run->options->error_goal, truncation = truncation_of(run);
    return truncation < most ? sqrt(most * most - truncation * truncation) : -1;
}

static bool refine(Run *run, Adaptive *adaptive, double start, const RenderObserver *observer,
                   Error *error)
{
    const Options *options = run->options;
    Report *report = &run->report;
    const GoalTime time = {start, options->time_goal};
    GoalOutcome outcome = {.threshold = (float)options->contrast, .reached = true};
    bool ok = true;
    if (options->contrast > 0)
        ok = adaptive_refine(adaptive, outcome.threshold, observer, error);
    else if (options->time_goal > 0)
        ok = goal_spend_time(adaptive, &time, observer, &outcome, error);
    else if (error_left(run) > 0)
        ok = goal_reach_error(adaptive, error_left(run), observer, &outcome, error);
    else
        outcome.reached = false;
    report->contrast = options->contrast > 0 ? options->contrast : (double)outcome.threshold;
    report->estimate = outcome.estimate > 0 ? hypot(outcome.estimate, truncation_of(run)) : 0;
    report->goal_missed = !outcome.reached;
    report->samples = adaptive->samples;
    return ok;
}

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
    const double start = clock_seconds();
    Crew *crew = crew_open(threads_allowed(run->options->threads));
    const AdaptiveSetup setup = {&run->renderer, &run->flat,  camera,
                                 crew,           &run->scene, &run->normalization};
    bool ok = adaptive_open(&adaptive, &setup, observer, error) &&
              refine(run, &adaptive, start, observer, error);
    if (ok) {
        adaptive_store(&adaptive, &run->framebuffer);
        ok = keep_counts(run, &adaptive.tree, error);
    }
    adaptive_close(&adaptive);
    crew_close(crew);
    return ok;
}
