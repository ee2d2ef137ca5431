// SPDX-License-Identifier: MIT
// Sorts the times to find the median and the slowest frames.
#include "view/frame_times.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

bool frame_times_add(FrameTimes *times, double moment, Error *error)
{
    const double before = times->latest;
    times->latest = moment;
    return before == 0 || array_push(&times->seconds, moment - before, error);
}

static int compare(const void *first, const void *second)
{
    const double *a = first, *b = second;
    return (*a > *b) - (*a < *b);
}

void frame_times_write(const FrameTimes *times, uint64_t coarse, uint64_t frames, FILE *stream)
{
    Error error = {0};
    const size_t count = times->seconds.count;
    double *sorted = memory_raw(count, sizeof *sorted, &error);
    if (sorted != NULL && count > 0) {
        memcpy(sorted, times->seconds.data, count * sizeof *sorted);
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

void frame_times_free(FrameTimes *times)
{
    free(times->seconds.memory);
    *times = (FrameTimes){0};
}
