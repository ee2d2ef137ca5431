// SPDX-License-Identifier: MIT
// The handlers stay installed while the picture is written, so that one signal never loses traced
// tiles. Nothing waits for the driver's compiler, which cannot be interrupted.
#include "cli/process.h"

#include <signal.h>
#include <stdbool.h>
#include <stddef.h>
#include <unistd.h>

static volatile sig_atomic_t stopped_by, waits_for_tiles;
static pid_t watcher;

// Forks of this process read or write pictures. They end without a message.
static void end_process(int number)
{
    static const char sentence[] = "clrt: stopped before the first tile: no picture is written\n";
    const bool speaks = getpid() == watcher;
    const ssize_t told = speaks ? write(STDERR_FILENO, sentence, sizeof sentence - 1) : 0;
    (void)told; // the process ends even if the message cannot be written
    _exit(128 + number);
}

static void stop(int number)
{
    if (!waits_for_tiles)
        end_process(number);
    stopped_by = number;
}

// A signal that is ignored, as in a background job, stays ignored.
static void take_signal(int number)
{
    struct sigaction before;
    // SA_RESETHAND: the second signal has the default action.
    struct sigaction action = {.sa_handler = stop, .sa_flags = (int)SA_RESETHAND};
    sigemptyset(&action.sa_mask);
    sigaction(number, NULL, &before);
    if (before.sa_handler != SIG_IGN)
        sigaction(number, &action, NULL);
}

void stop_watch(void)
{
    watcher = getpid();
    take_signal(SIGINT);
    take_signal(SIGTERM);
}

void stop_wait_for_tiles(void)
{
    waits_for_tiles = 1;
}

int stop_signal(void)
{
    return stopped_by;
}
