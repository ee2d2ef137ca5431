// SPDX-License-Identifier: MIT
#include "certainty/real_draw.h"

#include "base/processors.h"
#include "base/thread_pool.h"

#include <stdatomic.h>

typedef struct {
    const Certified *certified;
    RealView view;
    uint32_t step;
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

static void compare_row(void *context, uint32_t row, uint32_t worker)
{
    Comparing *comparing = context;
    (void)worker;
    for (uint32_t x = 0; x < comparing->view.width; x += comparing->step)
        compare_pixel(comparing, x, row * comparing->step);
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
    if (ok) {
        ThreadPool *pool = thread_pool_open(processors_usable());
        thread_pool_run(pool, (comparing.view.height + step - 1) / step, compare_row, &comparing);
        thread_pool_close(pool);
    }
    *comparison = (Comparison){comparing.compared, comparing.first, comparing.deeper,
                               comparing.unsettled, comparing.in_113};
    real_tree_free(&tree);
    return ok;
}
