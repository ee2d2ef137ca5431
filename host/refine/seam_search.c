// SPDX-License-Identifier: MIT
// The lines of a group run along the axis with the larger color differences, so that they cross
// color edges. Three lines locate a straight edge exactly.
#include "refine/refine_tree.h"

#include <stdlib.h>

// seam_correct assumes the color step in the middle of the remaining interval. It measures in
// halves of a last-level cell, so that positions are integers. Negative corrections wrap around in
// unsigned sums, and the final sums are correct.

#define PIXEL_AREA (81.0f * 81)
#define LEAST_STEP (1 / 256.0f)

bool seam_steps(const SampleData *const line[LINE_SAMPLES], uint32_t gap)
{
    const SampleData *first = line[gap], *last = line[gap + 1];
    if (first->signature != last->signature)
        return true;
    const float half = seam_difference(first, last) / 2;
    return half > LEAST_STEP / 2 && (gap == 0 || seam_difference(line[gap - 1], first) < half) &&
           (gap + 1 == LINE_GAPS || seam_difference(last, line[gap + 2]) < half);
}

float seam_contrast(const Seam *seam)
{
    const int area = (seam->high - seam->low) * seam->side;
    return seam_difference(&seam->ends[0], &seam->ends[1]) * (float)area / PIXEL_AREA;
}

bool seam_asks(const Seam *seam, uint32_t place[2])
{
    const uint32_t between = (seam->low + seam->high) / 2u;
    const uint32_t along = seam->assumed == SEAM_END_FIRST  ? seam->from
                           : seam->assumed == SEAM_END_LAST ? seam->to
                                                            : between;
    place[0] = seam->x + (seam->stride == 1 ? along : 0);
    place[1] = seam->y + (seam->stride == 1 ? 0 : along);
    return seam->assumed != SEAM_ENDS || seam->high - seam->low > 1;
}

// Returns whether a sample resembles one end and not the other.
static bool is_like(const SampleData *sample, const SampleData *end, const SampleData *other)
{
    if (end->signature != other->signature)
        return sample->signature == end->signature;
    return sample->signature == end->signature &&
           2 * seam_difference(sample, end) < seam_difference(sample, other);
}

void seam_close(Seam *seam)
{
    seam->low = seam->high = seam->from;
    seam->assumed = SEAM_ENDS;
}

// If the sample at the border matches the cell, the line has no step in this gap.
static void take_border(Seam *seam, const SampleData *sample)
{
    const SampleData *cell = &seam->ends[SEAM_END_LAST - seam->assumed];
    if (is_like(sample, cell, &seam->ends[seam->assumed]))
        seam->low = seam->high = seam->from;
    seam->ends[seam->assumed] = *sample;
    seam->assumed = SEAM_ENDS;
}

bool seam_take(Seam *seam, const SampleData *sample, Seam *rest)
{
    const uint8_t middle = (uint8_t)((seam->low + seam->high) / 2u);
    seam->samples++;
    if (seam->assumed != SEAM_ENDS) {
        take_border(seam, sample);
        return false;
    }
    if (is_like(sample, &seam->ends[0], &seam->ends[1])) {
        seam->low = middle;
        return false;
    }
    if (is_like(sample, &seam->ends[1], &seam->ends[0])) {
        seam->high = middle;
        return false;
    }
    *rest = *seam;
    rest->ends[0] = seam->ends[1] = *sample;
    rest->from = rest->low = seam->to = seam->high = middle;
    rest->samples = 0;
    return true;
}

// An interval of the line, in halves of a last-level cell, and the sample that represents it.
typedef struct {
    uint32_t begin, end;
    const SampleData *seen;
} Stretch;

static uint32_t overlap(const Stretch *stretch, uint32_t begin, uint32_t end)
{
    const uint32_t first = stretch->begin > begin ? stretch->begin : begin;
    const uint32_t last = stretch->end < end ? stretch->end : end;
    return first < last ? last - first : 0;
}

static void correct_cell(const Stretch *stretch, const SampleData *cell, uint32_t weight,
                         ColorSum sum)
{
    for (int channel = 0; channel < 3; channel++)
        sum[channel] += weight * (seam_color_steps(stretch->seen->color[channel]) -
                                  seam_color_steps(cell->color[channel]));
}

void seam_correct(const Seam *seam, const SampleData cells[], ColorSum sums[])
{
    const uint32_t side = seam->side, length = seam->cells * side;
    if (seam->assumed != SEAM_ENDS || seam->low == seam->high)
        return;
    const uint32_t step = seam->low + seam->high + 1u;
    const uint32_t begin = seam->from == 0 ? 0 : 2u * seam->from + 1;
    const uint32_t end = seam->to + 1u == length ? 2 * length : 2u * seam->to + 1;
    const Stretch parts[2] = {{begin, step, &seam->ends[0]}, {step, end, &seam->ends[1]}};
    const uint32_t first = seam->line * (seam->stride == 1 ? GROUP_SIDE : 1u);
    for (uint32_t i = 0; i < seam->cells; i++)
        for (int part = 0; part < 2; part++) {
            const uint32_t cell = first + i * seam->stride;
            const uint32_t held = overlap(&parts[part], 2 * side * i, 2 * side * (i + 1));
            if (held > 0)
                correct_cell(&parts[part], &cells[cell], held * side, sums[cell]);
        }
}

#define GROUPS_OF_TASK 512

// The result of a range.
typedef struct {
    ARRAY(Seam) seams;
    uint32_t base; // index of the first
    Error error;
} OpeningPart;

typedef struct {
    RefineTree *tree;
    uint32_t first;
    OpeningPart *parts; // of each range
} Opening;

// Returns the weighted sum of color differences along the rows or columns of a group.
static float changes_along(const CellGroup *group, uint32_t stride)
{
    const CellSide side = stride == 1 ? SIDE_LEFT : SIDE_ABOVE;
    const SampleData *middle = &group->cells[GROUP_MIDDLE];
    float changes = seam_difference(middle - stride, &group->beyond[side]) +
                    seam_difference(middle + stride, &group->beyond[side + 1]);
    for (uint32_t line = 0; line < GROUP_SIDE; line++) {
        const SampleData *cells = &group->cells[line * (stride == 1 ? GROUP_SIDE : 1)];
        changes += 2 * (seam_difference(&cells[0], &cells[stride]) +
                        seam_difference(&cells[stride], &cells[2 * stride]));
    }
    return changes;
}

// A line of a group.
typedef struct {
    const CellGroup *group;
    uint32_t number;         // of the group
    uint32_t line, stride;   // index of the line, and step from cell to cell
    uint32_t start[2];       // place in the picture
    const SampleData *cells; // first cell
} GroupLine;

static GroupLine line_of(const RefineTree *tree, uint32_t number, uint32_t stride, uint32_t line)
{
    const CellGroup *group = &tree->groups.data[number];
    const uint32_t side = refine_tree_cell_side(group->level), half = GROUP_SIDE * side / 2;
    const uint32_t across = line * side + side / 2, is_row = stride == 1;
    return (GroupLine){
        .group = group,
        .number = number,
        .line = line,
        .stride = stride,
        .start = {group->x - half + (is_row ? 0 : across), group->y - half + (is_row ? across : 0)},
        .cells = &group->cells[line * (is_row ? GROUP_SIDE : 1)]};
}

// Returns the sample of the smallest cell beyond an end of a line. At the picture's edge, returns
// the line's last sample at that end.
static const SampleData *beyond(const RefineTree *tree, const GroupLine *line, SeamEnd end)
{
    const uint32_t length = GROUP_SIDE * refine_tree_cell_side(line->group->level);
    const uint32_t step = end == SEAM_END_FIRST ? UINT32_MAX : length; // or one back
    uint32_t place[2] = {line->start[0], line->start[1]};
    place[line->stride == 1 ? 0 : 1] += step;
    if (place[0] < tree->width * REFINE_GRID && place[1] < tree->height * REFINE_GRID)
        return refine_tree_sample_at(tree, place);
    return &line->cells[end == SEAM_END_FIRST ? 0 : 2 * (size_t)line->stride];
}

// Returns the seam in a gap of a line with these samples.
static Seam seam_in_gap(const GroupLine *line, const SampleData *const seen[LINE_SAMPLES],
                        uint32_t gap)
{
    const uint32_t side = refine_tree_cell_side(line->group->level), middle = side / 2;
    const uint32_t places[LINE_SAMPLES] = {0, middle, middle + side, middle + 2 * side,
                                           GROUP_SIDE * side - 1};
    Seam seam = {.ends = {*seen[gap], *seen[gap + 1]},
                 .x = line->start[0],
                 .y = line->start[1],
                 .group = line->number,
                 .stride = (uint8_t)line->stride,
                 .cells = GROUP_SIDE,
                 .side = (uint8_t)side,
                 .line = (uint8_t)line->line,
                 .assumed = SEAM_ENDS};
    seam.from = seam.low = (uint8_t)places[gap];
    seam.to = seam.high = (uint8_t)places[gap + 1];
    if (gap == 0 || gap == LINE_GAPS - 1)
        seam.assumed = gap == 0 ? SEAM_END_FIRST : SEAM_END_LAST;
    return seam;
}

static bool open_line(const RefineTree *tree, const GroupLine *line, OpeningPart *part)
{
    const SampleData *cells = line->cells;
    const SampleData *const seen[LINE_SAMPLES] = {
        beyond(tree, line, SEAM_END_FIRST), cells, cells + line->stride,
        cells + 2 * (size_t)line->stride, beyond(tree, line, SEAM_END_LAST)};
    for (uint32_t gap = 0; gap < LINE_GAPS; gap++) {
        if (!seam_steps(seen, gap))
            continue;
        const Seam seam = seam_in_gap(line, seen, gap);
        if (!array_push(&part->seams, seam, &part->error))
            return false;
    }
    return true;
}

static bool open_group(const RefineTree *tree, uint32_t number, OpeningPart *part)
{
    const CellGroup *group = &tree->groups.data[number];
    const float rows = changes_along(group, 1), columns = changes_along(group, GROUP_SIDE);
    if (group->level == REFINE_LEVELS || rows + columns <= 0)
        return true;
    for (uint32_t i = 0; i < GROUP_SIDE; i++) {
        const GroupLine line = line_of(tree, number, rows >= columns ? 1 : GROUP_SIDE, i);
        if (!open_line(tree, &line, part))
            return false;
    }
    return true;
}

static void open_groups(void *context, uint32_t first, uint32_t end)
{
    const Opening *opening = context;
    OpeningPart *part = &opening->parts[first / GROUPS_OF_TASK];
    for (uint32_t i = first; i < end; i++)
        if (!open_group(opening->tree, opening->first + i, part))
            return;
}

static void link_seams(void *context, uint32_t task, uint32_t worker)
{
    (void)worker;
    const Opening *opening = context;
    const OpeningPart *part = &opening->parts[task];
    for (uint32_t i = 0; i < part->seams.count; i++) {
        const uint32_t number = part->base + i;
        Seam *seam = &opening->tree->seams.data[number];
        CellGroup *group = &opening->tree->groups.data[part->seams.data[i].group];
        *seam = part->seams.data[i];
        seam->next = group->seams;
        group->seams = number;
    }
}

static bool append_parts(Opening *opening, uint32_t tasks, ThreadPool *pool, Error *error)
{
    RefineTree *tree = opening->tree;
    size_t count = tree->seams.count;
    for (uint32_t task = 0; task < tasks; task++) {
        opening->parts[task].base = (uint32_t)count;
        count += opening->parts[task].seams.count;
    }
    if (count > UINT32_MAX / 8)
        return error_set(error, "the picture is refined into too many seams");
    if (!array_reserve(&tree->seams.memory, &tree->seams.capacity, count, sizeof *tree->seams.data,
                       error))
        return false;
    tree->seams.count = count;
    thread_pool_run(pool, tasks, link_seams, opening);
    return true;
}

static bool all_opened(const Opening *opening, uint32_t tasks, Error *error)
{
    for (uint32_t task = 0; task < tasks; task++)
        if (opening->parts[task].error.text[0] != '\0')
            return error_set(error, "%s", opening->parts[task].error.text);
    return true;
}

bool seam_search_open(RefineTree *tree, uint32_t first, uint32_t end, ThreadPool *pool,
                      Error *error)
{
    const uint32_t tasks = range_count(end - first, GROUPS_OF_TASK);
    Opening opening = {tree, first, NULL};
    opening.parts = memory_zeroed(tasks, sizeof *opening.parts, error);
    if (opening.parts == NULL)
        return false;
    thread_pool_share(pool, end - first, GROUPS_OF_TASK, open_groups, &opening);
    const bool ok =
        all_opened(&opening, tasks, error) && append_parts(&opening, tasks, pool, error);
    for (uint32_t task = 0; task < tasks; task++)
        free(opening.parts[task].seams.data);
    free(opening.parts);
    return ok;
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
