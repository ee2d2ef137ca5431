// SPDX-License-Identifier: MIT
#include "refine/thin_places.h"

// The approximate number of samples that a level takes for each probe, including samples on
// additional lines.
#define ADDED_SAMPLES 3

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

bool thin_parts_add(ThinParts *parts, const Probe *probe, Error *error)
{
    const uint32_t height = band_height(probe->level);
    parts->counts[probe->level] += probe->line % height == height / 2;
    return array_push(&parts->probes, *probe, error);
}

void thin_parts_touch(ThinParts *parts, uint32_t pixel, ThinAxis axis)
{
    if (parts->axes[pixel] != THIN_NONE)
        return;
    parts->axes[pixel] = (uint8_t)axis;
    parts->touched++;
}

uint32_t thin_parts_affordable(const ThinParts *parts)
{
    const double most = (double)THIN_SAMPLES * parts->width * parts->height;
    double samples = FIRST_SAMPLES * (double)parts->touched;
    uint32_t level = 0;
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
