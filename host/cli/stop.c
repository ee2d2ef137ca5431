// SPDX-License-Identifier: MIT
// After the first tile has begun, the handler only sets a flag, so the first signal never
// interrupts the writing of traced tiles. The second signal ends the process. Before the first
// tile, even the first signal ends the process, because compilation cannot be interrupted.
#include "cli/stop.h"

#include <signal.h>
#include <stdbool.h>
#include <stddef.h>
#include <unistd.h>

static volatile sig_atomic_t stopped_by, waits_for_tiles;
static pid_t watcher;

// Ends the process. Forked processes print no message.
static void end_process(int number)
{
    static const char sentence[] = "clrt: stopped before the first tile: no picture is written\n";
    const bool speaks = getpid() == watcher;
    const ssize_t written = speaks ? write(STDERR_FILENO, sentence, sizeof sentence - 1) : 0;
    (void)written; // the process ends even if the message cannot be written
    _exit(128 + number);
}

// Runs only once for each signal.
static void stop(int number)
{
    signal(number, SIG_DFL);
    if (!waits_for_tiles)
        end_process(number);
    stopped_by = number;
}

// Installs the handler. A signal that is already ignored, as in a background job, stays ignored.
// signal() sets SA_RESTART, so that a signal does not interrupt a write to a full pipe.
static void take_signal(int number)
{
    struct sigaction before;
    sigaction(number, NULL, &before);
    if (before.sa_handler != SIG_IGN)
        signal(number, stop);
}

void stop_watch(void)
{
    watcher = getpid();
    take_signal(SIGINT);
    take_signal(SIGTERM);
    take_signal(SIGHUP);
}

void stop_wait_for_tiles(void)
{
    waits_for_tiles = 1;
}

int stop_signal(void)
{
    return stopped_by;
}
