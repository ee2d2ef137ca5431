// SPDX-License-Identifier: MIT
// Each thread repeatedly takes the next row.
#include "certainty/real_draw.h"

#include <pthread.h>
#include <stdatomic.h>
#include <unistd.h>

#define THREADS_MAX 64

typedef struct {
    const Certified *certified;
    RealView view;
    uint32_t step;
    atomic_uint next_row;
    _Atomic uint64_t compared, first, deeper, unsettled, in_113;
} Comparing;

static void compare_pixel(Comparing *comparing, uint32_t x, uint32_t y)
{
    const CertaintyMap *map = &comparing->certified->map;
    const CertaintyMark *mark = &map->marks[(size_t)y * map->width + x];
    if (mark->certainty == CERTAINTY_OPEN)
        return;
    RealDecisions real = real_decide_64(&comparing->view, x, y);
    if (!real.settled) {
        comparing->in_113++;
        real = real_decide_113(&comparing->view, x, y);
    }
    const bool same = real.first_id == mark->first_id && real.lit == mark->lit;
    comparing->compared++;
    comparing->unsettled += !real.first_settled;
    comparing->first += !same;
    comparing->deeper += same && real.settled && real.signature != mark->signature;
}

static void *compare_rows(void *context)
{
    Comparing *comparing = context;
    for (;;) {
        const uint32_t row = atomic_fetch_add(&comparing->next_row, 1) * comparing->step;
        if (row >= comparing->view.height)
            return NULL;
        for (uint32_t x = 0; x < comparing->view.width; x += comparing->step)
            compare_pixel(comparing, x, row);
    }
}

static void run(Comparing *comparing)
{
    pthread_t threads[THREADS_MAX];
    const long processors = sysconf(_SC_NPROCESSORS_ONLN);
    int started = 0;
    while (started < processors - 1 && started < THREADS_MAX &&
           pthread_create(&threads[started], NULL, compare_rows, comparing) == 0)
        started++;
    compare_rows(comparing);
    while (started > 0)
        pthread_join(threads[--started], NULL);
}

bool real_compare(Comparison *comparison, const Certified *certified, uint32_t step, Error *error)
{
    RealTree tree;
    const bool ok = real_tree_make(&tree, &certified->flat, error);
    Comparing comparing = {.certified = certified,
                           .view = {&certified->flat, &tree, &certified->camera,
                                    certified->settings.width, certified->settings.height,
                                    certified->settings.max_level},
                           .step = step};
    if (ok)
        run(&comparing);
    *comparison = (Comparison){comparing.compared, comparing.first, comparing.deeper,
                               comparing.unsettled, comparing.in_113};
    real_tree_free(&tree);
    return ok;
}
