// SPDX-License-Identifier: MIT
// Looks for runs of drawn places on the lines of each level, from the first level on.
#include "refine/thin_places.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

// The approximate number of samples that a level takes for each probe, including samples on
// additional lines.
#define ADDED_SAMPLES 3

void thin_parts_touch(ThinParts *parts, uint32_t pixel, ThinAxis axis)
{
    uint8_t none = THIN_NONE;
    parts->touched += atomic_compare_exchange_strong(&parts->axes[pixel], &none, (uint8_t)axis);
}

uint32_t thin_parts_affordable(ThinParts *parts)
{
    const double most = (double)THIN_SAMPLES * parts->pixels.counts[0] * parts->pixels.counts[1];
    double samples = FIRST_SAMPLES * (double)parts->touched;
    uint32_t level = 0;
    for (; parts->counted < parts->probes.count; parts->counted++) {
        const Probe *probe = &parts->probes.data[parts->counted];
        const uint32_t height = band_height(probe->level);
        parts->counts[probe->level] += probe->line % height == height / 2;
    }
    for (; level < REFINE_LEVELS; level++) {
        samples += ADDED_SAMPLES * (double)parts->counts[level];
        if (samples > most)
            break;
    }
    return level;
}

size_t thin_parts_first_probe(const ThinParts *parts, uint32_t pixel)
{
    size_t first = 0, end = parts->probes.count;
    while (first < end) {
        const size_t middle = first + (end - first) / 2;
        if (parts->probes.data[middle].pixel < pixel)
            first = middle + 1;
        else
            end = middle;
    }
    return first;
}

int thin_compare_pixels(const void *one, const void *other)
{
    const uint32_t first = *(const uint32_t *)one, second = *(const uint32_t *)other;
    return (first > second) - (first < second);
}

bool probe_list_add(ProbeList *probes, const ProbeRun *run, Error *error)
{
    const int places[4] = {run->first - 1, run->first, run->end - 1, run->end};
    for (int i = 0; i < 4; i++) {
        const Probe probe = {run->pixel, (uint8_t)run->line, (uint8_t)places[i],
                             (uint8_t)run->level};
        if (places[i] >= 0 && places[i] < REFINE_GRID && !(i > 0 && places[i] == places[i - 1]) &&
            !array_push(probes, probe, error))
            return false;
    }
    return true;
}

// Finds the next run of drawn places. The search starts at run->end.
static bool next_run(const uint8_t line[REFINE_GRID], ProbeRun *run)
{
    const uint8_t *first = memchr(line + run->end, PLACE_DRAWN, REFINE_GRID - (size_t)run->end);
    if (first == NULL)
        return false;
    run->first = run->end = (int)(first - line);
    while (run->end < REFINE_GRID && line[run->end] == PLACE_DRAWN)
        run->end++;
    return true;
}

// Returns whether the lines of the previous level beside the run have probed places. These places
// are at most as far to the side as the lines are from the run.
static bool is_probed(ThinDrawing drawing, const ProbeRun *run)
{
    if (run->level == 0)
        return false;
    const int height = (int)band_height(run->level - 1);
    for (int line = height / 2; line < REFINE_GRID; line += height) {
        const int reach = abs(line - (int)run->line);
        const int first = run->first > reach ? run->first - reach : 0;
        const int end = run->end + reach < REFINE_GRID ? run->end + reach : REFINE_GRID;
        if (reach < height &&
            memchr(&drawing[line][first], PLACE_PROBED, (size_t)(end - first)) != NULL)
            return true;
    }
    return false;
}

// Adds the probes of each drawn run of a line. Runs near probed ones have no probes of the level,
// but on lines of level 1 they have probes of level 0. These probes are used only if the pixel gets
// lines of level 1.
static bool probe_line(ThinDrawing drawing, ProbeRun run, ProbeList *probes, Error *error)
{
    const uint32_t level = run.level;
    while (next_run(drawing[run.line], &run)) {
        run.level = level;
        const bool is_old = is_probed(drawing, &run);
        run.level = is_old ? 0 : level;
        if ((!is_old || level == 1) && !probe_list_add(probes, &run, error))
            return false;
        memset(&drawing[run.line][run.first], PLACE_PROBED, (size_t)(run.end - run.first));
    }
    return true;
}

bool thin_drawing_probe(ThinDrawing drawing, uint32_t pixel, uint32_t levels, ProbeList *probes,
                        Error *error)
{
    for (uint32_t level = 0; level < levels; level++)
        for (uint32_t line = band_height(level) / 2; line < REFINE_GRID; line += band_height(level))
            if (!probe_line(drawing, (ProbeRun){pixel, line, level, 0, 0}, probes, error))
                return false;
    return true;
}
