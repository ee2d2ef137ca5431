// SPDX-License-Identifier: MIT
// Calls the oracle only for differing pixels, which are few. An explanation costs up to 26 samples.
#include "image/comparison.h"

#include "unit/cmocka_all.h"

#include <string.h>

static void judge(Comparison *comparison, const OracleView *view, const uint32_t place[2],
                  const float color[3], const float expected[3])
{
    comparison->differing++;
    switch (oracle_explains(view, place[0], place[1], color)) {
    case EXPLAINED_BY_EDGE:
        comparison->at_edges++;
        return;
    case EXPLAINED_BY_CREASE:
        comparison->at_creases++;
        return;
    case EXPLAINED_BY_HORIZON:
        comparison->at_horizons++;
        return;
    case EXPLAINED_NOT:
        break;
    }
    if (comparison->unexplained++ > 0)
        return;
    comparison->x = place[0];
    comparison->y = place[1];
    memcpy(comparison->color, color, sizeof comparison->color);
    memcpy(comparison->expected, expected, sizeof comparison->expected);
}

Comparison comparison_make(const OracleView *view, const Framebuffer *picture,
                           const Framebuffer *expected, uint32_t step)
{
    Comparison comparison = {.compared = expected->width * expected->height};
    for (uint32_t i = 0; i < comparison.compared; i++) {
        const uint32_t place[2] = {i % expected->width * step, i / expected->width * step};
        const float *color = picture->pixels[(size_t)place[1] * picture->width + place[0]];
        const float difference = color_difference(color, expected->pixels[i]);
        if (!(difference <= COLOR_TOLERANCE))
            judge(&comparison, view, place, color, expected->pixels[i]);
        else
            comparison.largest_agreeing = fmaxf(comparison.largest_agreeing, difference);
    }
    return comparison;
}

void comparison_print(const Comparison *comparison, const char *name)
{
    print_message(
        "%s: %u of %u pixels differ (%u at edges, %u at creases, %u at horizons, %u unexplained), "
        "the others by %.2g at most\n",
        name, comparison->differing, comparison->compared, comparison->at_edges,
        comparison->at_creases, comparison->at_horizons, comparison->unexplained,
        (double)comparison->largest_agreeing);
    if (comparison->unexplained > 0)
        print_message("  unexplained at (%u, %u): %.6f %.6f %.6f, expected %.6f %.6f %.6f\n",
                      comparison->x, comparison->y, (double)comparison->color[0],
                      (double)comparison->color[1], (double)comparison->color[2],
                      (double)comparison->expected[0], (double)comparison->expected[1],
                      (double)comparison->expected[2]);
}

uint32_t comparison_allowance(const Comparison *comparison, uint32_t limit)
{
    const uint64_t picture = 512 * 512;
    return (uint32_t)((limit * (uint64_t)comparison->compared + picture - 1) / picture);
}
