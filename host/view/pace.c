// SPDX-License-Identifier: MIT
// Sorted times tell the median and the slow ones.
#include "view/pace.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

bool pace_add(Pace *pace, double moment, Error *error)
{
    const double before = pace->latest;
    pace->latest = moment;
    return before == 0 || array_push(&pace->seconds, moment - before, error);
}

void pace_pause(Pace *pace)
{
    pace->latest = 0;
}

static int compare(const void *first, const void *second)
{
    const double *a = first, *b = second;
    return (*a > *b) - (*a < *b);
}

void pace_write(const Pace *pace, uint64_t coarse, uint64_t frames, FILE *stream)
{
    Error error = {0};
    const size_t count = pace->seconds.count;
    double *sorted = memory_raw(count, sizeof *sorted, &error);
    if (sorted != NULL && count > 0) {
        memcpy(sorted, pace->seconds.data, count * sizeof *sorted);
        qsort(sorted, count, sizeof *sorted, compare);
        fprintf(stream,
                "%zu moving frames: median %.1f ms, 95 %% within %.1f ms, slowest %.1f ms\n", count,
                1e3 * sorted[count / 2], 1e3 * sorted[count * 95 / 100], 1e3 * sorted[count - 1]);
    }
    free(sorted);
    if (frames > 0)
        fprintf(stream, "%" PRIu64 " traced while moving, %" PRIu64 " of them at full resolution\n",
                frames, frames - coarse);
}

void pace_free(Pace *pace)
{
    free(pace->seconds.memory);
    *pace = (Pace){0};
}
