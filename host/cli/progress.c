// SPDX-License-Identifier: MIT
// A terminal gets one line that rewrites itself, with the time that is left; a log gets a plain
// line for every tenth of a picture that takes longer than a second.
#include "cli/progress.h"

#include "base/clock.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static volatile sig_atomic_t stopped_by;

static void stop(int signal_number)
{
    stopped_by = signal_number;
}

Progress progress_begin(bool silent)
{
    // SA_RESETHAND: the second signal meets the default action.
    struct sigaction action = {.sa_handler = stop, .sa_flags = (int)SA_RESETHAND};
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    const char *kind = getenv("TERM");
    const bool dumb = kind == NULL || strcmp(kind, "dumb") == 0;
    return (Progress){
        .silent = silent, .terminal = isatty(STDERR_FILENO) && !dumb, .start = clock_seconds()};
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
    return stopped_by;
}
