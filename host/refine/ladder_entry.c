// SPDX-License-Identifier: MIT
// Assigns each pixel to a stratum of rung 0 by its bend (ladder_bends.c). Each task sums the
// features of its pixels in order, and one thread then adds the tasks' sums in order. The result
// therefore does not depend on threads.
#include "refine/ladder.h"

#include <stdlib.h>

#define PIXELS_OF_TASK 4096

// Statistics of a task's pixels, by stratum.
typedef struct {
    uint32_t pixels[BEND_CLASSES];
    double features[BEND_CLASSES]; // sums
} Entries;

typedef struct {
    Ladder *ladder;
    float *bends, *nearby; // of each pixel
    Entries *entries;      // of each task
} Entering;

static void enter_part(void *context, uint32_t first, uint32_t end)
{
    const Entering *entering = context;
    Ladder *ladder = entering->ladder;
    Entries entries = {.pixels = {0}};
    for (uint32_t pixel = first; pixel < end; pixel++) {
        const double bend = (double)entering->bends[pixel];
        const uint32_t stratum = strata_of_bend(bend, (double)entering->nearby[pixel]);
        ladder->strata[pixel] = (uint8_t)stratum;
        ladder->places[pixel].feature = (float)(bend * bend);
        entries.pixels[stratum]++;
        entries.features[stratum] += (double)ladder->places[pixel].feature;
    }
    entering->entries[first / PIXELS_OF_TASK] = entries;
}

static void enter_all(const Entering *entering)
{
    Ladder *ladder = entering->ladder;
    ThreadPool *pool = ladder->requests.pool;
    const uint32_t pixels = (uint32_t)ladder->statistics.pixels;
    bends_measure(ladder->picture, pool, entering->bends);
    bends_spread(ladder->picture, pool, entering->bends, entering->nearby);
    thread_pool_share(pool, pixels, PIXELS_OF_TASK, enter_part, (void *)entering);
    for (uint32_t task = 0; task < range_count(pixels, PIXELS_OF_TASK); task++)
        for (uint32_t stratum = 0; stratum < BEND_CLASSES; stratum++)
            strata_enter(&ladder->statistics, stratum, entering->entries[task].pixels[stratum],
                         entering->entries[task].features[stratum]);
}

bool ladder_enter(Ladder *ladder, Error *error)
{
    const size_t pixels = ladder->statistics.pixels;
    const size_t tasks = range_count((uint32_t)pixels, PIXELS_OF_TASK);
    Entering entering = {ladder, memory_raw(pixels, sizeof(float), error),
                         memory_raw(pixels, sizeof(float), error),
                         memory_raw(tasks, sizeof(Entries), error)};
    const bool ok = entering.bends != NULL && entering.nearby != NULL && entering.entries != NULL;
    if (ok)
        enter_all(&entering);
    free(entering.bends);
    free(entering.nearby);
    free(entering.entries);
    return ok;
}
