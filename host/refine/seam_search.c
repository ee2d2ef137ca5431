// SPDX-License-Identifier: MIT
// Finds seams on the three lines of each group. The lines are the rows, or the columns if colors
// change more along the columns. The lines therefore cross color edges. Seams on three lines
// describe a straight edge.
#include "refine/seam_search.h"

#include <stdlib.h>

// The samples of a line: one per cell, and one beyond each end. Gaps separate the samples.
#define LINE_SAMPLES (GROUP_SIDE + 2)
#define LINE_GAPS    (LINE_SAMPLES - 1)

// The smallest color change of a seam on one surface, for example between two faces of a cube.
#define LEAST_STEP (1 / 256.0f)

// A row or a column of a group.
typedef struct {
    uint32_t group, stride, number; // stride: from cell to cell; number: 0 to 2
    uint32_t start[2];              // place in the picture
    const SampleData *samples[LINE_SAMPLES];
} GroupLine;

// Returns the sample of the smallest cell at a place. Outside of the picture, returns `inside`.
static const SampleData *sample_at(const RefineTree *tree, const uint32_t place[2],
                                   const SampleData *inside)
{
    CellName name;
    return refine_tree_find(tree, place, &name) ? refine_tree_sample(tree, &name) : inside;
}

static GroupLine line_of(const RefineTree *tree, uint32_t number, uint32_t stride, uint32_t line)
{
    const CellGroup *group = &tree->groups.data[number];
    const uint32_t side = refine_tree_cell_side(group->level), length = GROUP_SIDE * side;
    const int along = stride == 1 ? 0 : 1;
    const SampleData *cells = &group->cells[line * (stride == 1 ? GROUP_SIDE : 1)];
    GroupLine found = {number, stride, line, {group->x, group->y}, {NULL}};
    found.start[along] -= length / 2;
    found.start[1 - along] += line * side - side;
    for (size_t i = 0; i < GROUP_SIDE; i++)
        found.samples[i + 1] = &cells[i * stride];
    uint32_t before[2] = {found.start[0], found.start[1]}, after[2] = {before[0], before[1]};
    before[along]--;
    after[along] += length;
    found.samples[0] = sample_at(tree, before, found.samples[1]);
    found.samples[LINE_GAPS] = sample_at(tree, after, found.samples[LINE_GAPS - 1]);
    return found;
}

// Returns the sum of color differences along the rows or columns of a group.
static float changes_along(const GroupLine lines[GROUP_SIDE])
{
    float changes = 0;
    for (int i = 0; i < GROUP_SIDE; i++)
        for (int gap = 0; gap < LINE_GAPS; gap++)
            changes += seam_difference(lines[i].samples[gap], lines[i].samples[gap + 1]);
    return changes;
}

// Returns the seam in a gap of a line.
static Seam seam_in_gap(const RefineTree *tree, const GroupLine *line, uint32_t gap)
{
    const CellGroup *group = &tree->groups.data[line->group];
    const uint32_t side = refine_tree_cell_side(group->level), middle = side / 2;
    const uint32_t places[LINE_SAMPLES] = {0, middle, middle + side, middle + 2 * side,
                                           GROUP_SIDE * side - 1};
    Seam seam = {.ends = {*line->samples[gap], *line->samples[gap + 1]},
                 .x = line->start[0],
                 .y = line->start[1],
                 .next = group->seams,
                 .stride = (uint8_t)line->stride,
                 .side = (uint8_t)side,
                 .line = (uint8_t)line->number,
                 .assumed = SEAM_ENDS};
    seam.from = seam.low = (uint8_t)places[gap];
    seam.to = seam.high = (uint8_t)places[gap + 1];
    if (gap == 0 || gap == LINE_GAPS - 1)
        seam.assumed = gap == 0 ? SEAM_END_FIRST : SEAM_END_LAST;
    return seam;
}

// Returns whether colors change abruptly in a gap: the signatures differ, or the color changes by
// more than LEAST_STEP and by more than twice as much as in the gaps beside it.
static bool is_step(const GroupLine *line, uint32_t gap)
{
    const SampleData *const *samples = line->samples;
    if (samples[gap]->signature != samples[gap + 1]->signature)
        return true;
    const float half = seam_difference(samples[gap], samples[gap + 1]) / 2;
    return half > LEAST_STEP / 2 &&
           (gap == 0 || seam_difference(samples[gap - 1], samples[gap]) < half) &&
           (gap + 1 == LINE_GAPS || seam_difference(samples[gap + 1], samples[gap + 2]) < half);
}

static bool open_line(RefineTree *tree, const GroupLine *line, Error *error)
{
    for (uint32_t gap = 0; gap < LINE_GAPS; gap++) {
        if (!is_step(line, gap))
            continue;
        const Seam seam = seam_in_gap(tree, line, gap);
        if (tree->seams.count > UINT32_MAX / 8)
            return error_set(error, "the picture is refined into too many seams");
        tree->groups.data[line->group].seams = (uint32_t)tree->seams.count;
        if (!array_push(&tree->seams, seam, error))
            return false;
    }
    return true;
}

static bool open_group(RefineTree *tree, uint32_t number, Error *error)
{
    GroupLine rows[GROUP_SIDE], columns[GROUP_SIDE];
    bool ok = true;
    for (uint32_t i = 0; i < GROUP_SIDE; i++) {
        rows[i] = line_of(tree, number, 1, i);
        columns[i] = line_of(tree, number, GROUP_SIDE, i);
    }
    const GroupLine *lines = changes_along(rows) >= changes_along(columns) ? rows : columns;
    for (int i = 0; ok && i < GROUP_SIDE; i++)
        ok = open_line(tree, &lines[i], error);
    return ok;
}

bool seam_search_open(RefineTree *tree, uint32_t first, Error *error)
{
    for (uint32_t number = first; number < tree->groups.count; number++)
        if (tree->groups.data[number].level < REFINE_LEVELS && !open_group(tree, number, error))
            return false;
    return true;
}

static bool wants(const Seam *seam, float threshold)
{
    uint32_t place[2];
    return seam_asks(seam, place) && seam_contrast(seam) > threshold;
}

bool seam_search_ask(SeamSearch *search, const RefineTree *tree, float threshold, Error *error)
{
    size_t kept = 0;
    for (size_t i = 0; i < search->asked.count; i++)
        if (wants(&tree->seams.data[search->asked.data[i]], threshold))
            search->asked.data[kept++] = search->asked.data[i];
    search->asked.count = kept;
    for (; search->seen < tree->seams.count; search->seen++)
        if (wants(&tree->seams.data[search->seen], threshold) &&
            !array_push(&search->asked, search->seen, error))
            return false;
    return true;
}

bool seam_search_take(const SeamSearch *search, RefineTree *tree, const SampleData *samples,
                      Error *error)
{
    for (size_t i = 0; i < search->asked.count; i++) {
        const uint32_t number = search->asked.data[i];
        Seam rest;
        if (!seam_take(&tree->seams.data[number], &samples[i], &rest))
            continue;
        if (!array_push(&tree->seams, rest, error))
            return false;
        tree->seams.data[number].next = (uint32_t)tree->seams.count - 1;
    }
    return true;
}

void seam_search_free(SeamSearch *search)
{
    free(search->asked.data);
    *search = (SeamSearch){0};
}
