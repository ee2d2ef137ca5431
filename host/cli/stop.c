// SPDX-License-Identifier: MIT
// The handlers stay while the picture is written: one signal never loses what was traced.
#include "cli/stop.h"

#include <signal.h>
#include <stddef.h>

static volatile sig_atomic_t stopped_by;

static void stop(int signal_number)
{
    stopped_by = signal_number;
}

// A signal that is ignored, as in a background job, stays so.
static void take_signal(int number)
{
    struct sigaction before;
    // SA_RESETHAND: the second signal meets the default action.
    struct sigaction action = {.sa_handler = stop, .sa_flags = (int)SA_RESETHAND};
    sigemptyset(&action.sa_mask);
    sigaction(number, NULL, &before);
    if (before.sa_handler != SIG_IGN)
        sigaction(number, &action, NULL);
}

void stop_watch(void)
{
    take_signal(SIGINT);
    take_signal(SIGTERM);
}

int stop_signal(void)
{
    return stopped_by;
}
