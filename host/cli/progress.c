// SPDX-License-Identifier: MIT
// On a terminal, one line is rewritten and shows the remaining time, or the time spent on compiling
// kernels. A log gets a line for every tenth of the picture, but none in the first second.
#include "cli/process.h"

#include "base/clock.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

bool progress_on_terminal(void)
{
    const char *kind = getenv("TERM");
    return isatty(STDERR_FILENO) && kind != NULL && strcmp(kind, "dumb") != 0;
}

Progress progress_begin(bool silent)
{
    Progress progress = {
        .silent = silent, .terminal = progress_on_terminal(), .start = clock_seconds()};
    return progress;
}

// series counts the builds that began while no other build was running.
static atomic_uint running_builds, series;

// Rewrites the line every second until the last build of the series ends.
static void *show_seconds(void *own)
{
    for (unsigned seconds = 0; running_builds > 0 && series == (uintptr_t)own; seconds++) {
        fprintf(stderr, "\r\033[Kcompiling kernels, %u s", seconds);
        sleep(1);
    }
    return NULL;
}

void progress_show_compiling(bool begins)
{
    pthread_t thread;
    if (!begins && --running_builds == 0)
        fputs("\r\033[K", stderr);
    if (begins && running_builds++ == 0 &&
        pthread_create(&thread, NULL, show_seconds, (void *)(uintptr_t)++series) == 0)
        pthread_detach(thread);
}

// Estimates the remaining time from the tiles drawn by this process, because tiles of an earlier
// run took no time.
static void print_progress(Progress *progress, const RenderProgress *render)
{
    const double elapsed = clock_seconds() - progress->start;
    const unsigned percent = (unsigned)(100 * (double)render->tiles_done / (double)render->tiles);
    const double left = elapsed * (double)(render->tiles - render->tiles_done) /
                        (double)(render->tiles_done - render->tiles_ready);
    if (progress->terminal) {
        fprintf(stderr, "\r\033[Ktracing %u %%, %.0f s left", percent, left);
        fflush(stderr);
        progress->line_open = true;
    } else if (elapsed > 1 && percent / 10 > progress->printed / 10) {
        fprintf(stderr, "tracing %u %%, %.0f s left\n", percent, left);
        progress->printed = percent;
    }
}

bool progress_tile_done(void *context, const RenderProgress *render)
{
    Progress *progress = context;
    if (!progress->silent)
        print_progress(progress, render);
    return stop_signal() == 0;
}

int progress_end(Progress *progress)
{
    if (progress->line_open)
        fprintf(stderr, "\r\033[K");
    progress->line_open = false;
    return stop_signal();
}
