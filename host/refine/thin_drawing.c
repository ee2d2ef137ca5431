// SPDX-License-Identifier: MIT
// Looks for runs of drawn places on the lines of each level, from the first level on.
#include "refine/thin_drawing.h"

#include <string.h>

// Returns whether any place of `line` that is at most `reach` places from the run is drawn.
static bool is_near_drawn(const uint8_t line[REFINE_GRID], const ProbeRun *run, int reach)
{
    for (int place = run->first > reach ? run->first - reach : 0;
         place < run->end + reach && place < REFINE_GRID; place++)
        if (line[place] != PLACE_EMPTY)
            return true;
    return false;
}

// Marks the drawn places of `line` that adjoin probed places of `before` or of `line` as probed.
static void spread_probed(const uint8_t before[REFINE_GRID], uint8_t line[REFINE_GRID])
{
    uint32_t i;
    if (memchr(line, PLACE_DRAWN, REFINE_GRID) == NULL)
        return;
    for (i = 0; i < REFINE_GRID; i++)
        if (line[i] == PLACE_DRAWN &&
            (before[i] == PLACE_PROBED || (i > 0 && before[i - 1] == PLACE_PROBED) ||
             (i + 1 < REFINE_GRID && before[i + 1] == PLACE_PROBED) ||
             (i > 0 && line[i - 1] == PLACE_PROBED)))
            line[i] = PLACE_PROBED;
    while (--i > 0)
        if (line[i - 1] == PLACE_DRAWN && line[i] == PLACE_PROBED)
            line[i - 1] = PLACE_PROBED;
}

// Finds the next run of places with this state. The search starts at run->end.
static bool next_run(const uint8_t line[REFINE_GRID], PlaceState state, ProbeRun *run)
{
    int first = run->end;
    while (first < REFINE_GRID && line[first] != state)
        first++;
    run->first = run->end = first;
    while (run->end < REFINE_GRID && line[run->end] == state)
        run->end++;
    return first < REFINE_GRID;
}

// Returns whether the thin part at the run is much lower than the bands of the level.
static bool is_low(ThinDrawing drawing, const ProbeRun *run)
{
    const uint32_t height = band_height(run->level), reach = height / 3;
    return height > 1 && !is_near_drawn(drawing[run->line - reach], run, (int)reach) &&
           !is_near_drawn(drawing[run->line + reach], run, (int)reach);
}

// Adds the probes of each drawn run of a line.
static bool probe_line(ThinDrawing drawing, ProbeRun run, ProbeList *probes, Error *error)
{
    uint8_t *places = drawing[run.line];
    while (next_run(places, PLACE_DRAWN, &run)) {
        if (is_low(drawing, &run))
            continue;
        if (!probe_list_add(probes, &run, error))
            return false;
        memset(places + run.first, PLACE_PROBED, (size_t)(run.end - run.first));
    }
    return true;
}

// Adds probes on the lines of a level. Then marks connected places near these lines as probed.
static bool probe_level(ThinDrawing drawing, uint32_t pixel, uint32_t level, ProbeList *probes,
                        Error *error)
{
    const uint32_t height = band_height(level);
    for (uint32_t line = height / 2; line < REFINE_GRID; line += height)
        if (!probe_line(drawing, (ProbeRun){pixel, line, level, 0, 0}, probes, error))
            return false;
    for (uint32_t line = height / 2; line < REFINE_GRID; line += height)
        for (uint32_t step = 1; step < height; step++) {
            if (line + step < REFINE_GRID)
                spread_probed(drawing[line + step - 1], drawing[line + step]);
            if (step <= line)
                spread_probed(drawing[line - step + 1], drawing[line - step]);
        }
    return true;
}

// Adds probes of level 0 on the lines of level 1. These probes are used only if the pixel gets
// lines of level 1.
static bool probe_between(ThinDrawing drawing, uint32_t pixel, ProbeList *probes, Error *error)
{
    for (uint32_t line = band_height(1) / 2; line < REFINE_GRID; line += band_height(1)) {
        ProbeRun run = {.pixel = pixel, .line = line};
        while (next_run(drawing[line], PLACE_PROBED, &run))
            if (!probe_list_add(probes, &run, error))
                return false;
    }
    return true;
}

bool thin_drawing_probe(ThinDrawing drawing, uint32_t pixel, uint32_t levels, ProbeList *probes,
                        Error *error)
{
    for (uint32_t level = 0;
         level < levels && memchr(drawing, PLACE_DRAWN, sizeof(ThinDrawing)) != NULL; level++)
        if (!probe_level(drawing, pixel, level, probes, error))
            return false;
    return probe_between(drawing, pixel, probes, error);
}
