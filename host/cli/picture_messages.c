// SPDX-License-Identifier: MIT
// Prints notes about a picture, and describes pictures that miss a goal or are stopped.
#include "cli/picture_messages.h"

#include "base/print.h"
#include "cli/progress.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// Above this value of --error, the user may have meant a percentage.
#define LARGE_ERROR 0.1

// Parts of at least this many tiles take about the same time (docs/long-jobs.md).
#define PART_TILES 128

void picture_warn_of_goal(const Options *options)
{
    if (options->picture.error > LARGE_ERROR)
        stage_note(options, "--error allows an error of %g %%; for %g %%, write %g%%",
                   100 * options->picture.error, options->picture.error, options->picture.error);
}

void picture_warn_of_few_tiles(const Options *options, const RenderSettings *settings)
{
    RenderSettings whole = *settings;
    whole.part = whole.parts = 0;
    const unsigned long long tiles = tile_count(&whole);
    const unsigned long long most = tiles / PART_TILES > 1 ? tiles / PART_TILES : 1;
    if (settings->parts > most)
        stage_note(options,
                   "a part of fewer than %d tiles may take much longer than the others: for this "
                   "picture, give at most N=%llu",
                   PART_TILES, most);
}

void picture_print_beginning(const Picture *picture)
{
    if (!picture->options->verbose)
        return;
    if (frames_are_many(&picture->options->frames))
        print_text(stderr, "picture: %s\n", picture->path);
    if (picture->options->resume)
        fprintf(stderr, "resumed: %llu of %llu tiles were finished before\n",
                (unsigned long long)picture->request.settings.ready_tiles,
                (unsigned long long)tile_count(&picture->request.settings));
}

void picture_print_end(Picture *picture)
{
    const Framebuffer *framebuffer = &picture->framebuffer;
    const double seconds = stage_lap(&picture->moment);
    if (progress_on_terminal() && !picture->options->quiet && strcmp(picture->path, "-") != 0)
        print_text(stderr, "wrote %s (%ux%u, %.2f s)\n", picture->path, framebuffer->width,
                   framebuffer->height, seconds);
}

ExitCode picture_fail_goal(const Picture *picture, Error *error)
{
    if (picture->options->picture.seconds > 0)
        error_set(error,
                  "one sample a pixel took %.3f s, longer than --time allows: give more time or a "
                  "smaller --size",
                  picture->repetition_seconds[0]);
    else
        error_set(error, "the error may be %.2g %%, more than --error allows: give a larger error",
                  100 * fmax(picture->drawn.facts.error_bound, picture->drawn.facts.truncation));
    return EXIT_FAULTS;
}

ExitCode picture_fail_stopped(const Picture *picture, Error *error)
{
    const RenderProgress *progress = &picture->drawn.progress;
    const char *path = picture->path,
               *name = path == NULL || strcmp(path, "-") == 0 ? "the picture" : path;
    if (picture->complete)
        error_set(error, "stopped: %s is complete", name);
    else if (progress->tiles_done == progress->tiles || goal_is_given(&picture->options->picture))
        error_set(error, "stopped: %s is incomplete", name);
    else
        error_set(error, "stopped: %s is incomplete, with %llu of %llu tiles", name,
                  (unsigned long long)progress->tiles_done, (unsigned long long)progress->tiles);
    return (ExitCode)(128 + picture->stopped_by);
}
