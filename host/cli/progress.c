// SPDX-License-Identifier: MIT
// A terminal gets one line that rewrites itself, with the time that is left; a log gets a plain
// line for every tenth of a picture that takes longer than a second.
#include "cli/progress.h"

#include "base/clock.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static volatile sig_atomic_t stopped_by;

static void stop(int signal_number)
{
    stopped_by = signal_number;
}

// A signal that is ignored, as in a background job, stays so.
static void take_signal(int number, struct sigaction *before)
{
    // SA_RESETHAND: the second signal meets the default action.
    struct sigaction action = {.sa_handler = stop, .sa_flags = (int)SA_RESETHAND};
    sigemptyset(&action.sa_mask);
    sigaction(number, NULL, before);
    if (before->sa_handler != SIG_IGN)
        sigaction(number, &action, NULL);
}

Progress progress_begin(bool silent)
{
    const char *kind = getenv("TERM");
    const bool dumb = kind == NULL || strcmp(kind, "dumb") == 0;
    Progress progress = {
        .silent = silent, .terminal = isatty(STDERR_FILENO) && !dumb, .start = clock_seconds()};
    take_signal(SIGINT, &progress.interrupt);
    take_signal(SIGTERM, &progress.terminate);
    return progress;
}

static void print_progress(Progress *progress, double done, double elapsed)
{
    const unsigned percent = (unsigned)(done * 100);
    const double left = elapsed / done - elapsed;
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
        print_progress(progress, (double)render->tiles_done / (double)render->tiles,
                       clock_seconds() - progress->start);
    return stopped_by == 0;
}

int progress_end(Progress *progress)
{
    if (progress->line_open)
        fprintf(stderr, "\r\033[K");
    progress->line_open = false;
    sigaction(SIGINT, &progress->interrupt, NULL);
    sigaction(SIGTERM, &progress->terminate, NULL);
    return stopped_by;
}
