// SPDX-License-Identifier: MIT
// Shows progress on standard error. On a terminal, clrt rewrites a single line. The line shows the
// remaining time, or how long clrt has been loading the scene or compiling kernels. In a log, clrt
// prints a line for every tenth of the picture, but none in the first second.
#include "cli/progress.h"

#include "base/clock.h"
#include "cli/stop.h"

#include <pthread.h>
#include <stdint.h>
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

// Loading is shown only if it takes longer than this.
#define QUICK_MICROSECONDS 500000

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

// The stages that are running, such as compiling. Stages that overlap in time form a series and
// share the rewritten line.
static struct {
    unsigned running;
    uintptr_t series;
    const char *text;
    bool is_shown;
} stage;

// Rewrites the line, and returns true. If all stages of the series have ended, only returns false.
static bool show_line(uintptr_t series, unsigned seconds)
{
    pthread_mutex_lock(&lock);
    const bool is_running = stage.running > 0 && stage.series == series;
    if (is_running)
        fprintf(stderr, "\r\033[K%s, %u s", stage.text, seconds);
    stage.is_shown = stage.is_shown || is_running;
    pthread_mutex_unlock(&lock);
    return is_running;
}

static void *show_seconds(void *series)
{
    for (unsigned seconds = 0; show_line((uintptr_t)series, seconds); seconds++)
        sleep(1);
    return NULL;
}

static void *show_slow(void *series)
{
    usleep(QUICK_MICROSECONDS);
    return show_seconds(series);
}

static void show(const char *text, void *(*work)(void *), bool begins)
{
    pthread_t thread;
    pthread_mutex_lock(&lock);
    if (!begins && --stage.running == 0 && stage.is_shown) {
        fputs("\r\033[K", stderr);
        stage.is_shown = false;
    }
    if (begins && stage.running++ == 0) {
        stage.text = text;
        if (pthread_create(&thread, NULL, work, (void *)++stage.series) == 0)
            pthread_detach(thread);
    }
    pthread_mutex_unlock(&lock);
}

void progress_show_compiling(bool begins)
{
    show("compiling kernels", show_seconds, begins);
}

void progress_show_loading(bool begins)
{
    show("loading the scene", show_slow, begins);
}

// Prints the progress. The remaining time is estimated from the tiles that this process has drawn.
// Tiles of an earlier run do not count, because this process spent no time on them.
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
