// SPDX-License-Identifier: MIT
// Assigns each pixel to a stratum of rung 0 by its bend (ladder_bends.c), and by whether a thin
// part touches it. Each task sums the features of its pixels in order, and one thread then adds the
// tasks' sums in order. The result therefore does not depend on threads.
#include "refine/ladder.h"
#include "refine/thin_parts.h"

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
    ThinParts thin_parts;
} Entering;

static void enter_part(void *context, uint32_t first, uint32_t end)
{
    const Entering *entering = context;
    Ladder *ladder = entering->ladder;
    Entries entries = {.pixels = {0}};
    for (uint32_t pixel = first; pixel < end; pixel++) {
        const double bend = (double)entering->bends[pixel];
        const uint32_t stratum = strata_of_bend(bend, (double)entering->nearby[pixel],
                                                thin_parts_touch(&entering->thin_parts, pixel));
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

// Finds the pixels that thin parts touch.
static bool find_thin_parts(ThinParts *parts, const LadderSetup *setup, Error *error)
{
    FrameData frame = renderer_frame(setup->renderer, setup->camera);
    for (int axis = 0; axis < 3; axis++) {
        frame.camera.right_step[axis] *= (float)LADDER_GRID / REFINE_GRID;
        frame.camera.down_step[axis] *= (float)LADDER_GRID / REFINE_GRID;
    }
    const ThinSource source = {
        &frame, setup->scene, setup->normalization, setup->flat->spheres, setup->pool, 1};
    return thin_parts_make(parts, &source, error);
}

bool ladder_enter(Ladder *ladder, const LadderSetup *setup, Error *error)
{
    const size_t pixels = ladder->statistics.pixels;
    const size_t tasks = range_count((uint32_t)pixels, PIXELS_OF_TASK);
    Entering entering = {.ladder = ladder,
                         .bends = memory_raw(pixels, sizeof(float), error),
                         .nearby = memory_raw(pixels, sizeof(float), error),
                         .entries = memory_raw(tasks, sizeof(Entries), error)};
    const bool ok = entering.bends != NULL && entering.nearby != NULL && entering.entries != NULL &&
                    find_thin_parts(&entering.thin_parts, setup, error);
    if (ok)
        enter_all(&entering);
    free(entering.bends);
    free(entering.nearby);
    free(entering.entries);
    thin_parts_free(&entering.thin_parts);
    return ok;
}
