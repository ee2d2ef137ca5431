// SPDX-License-Identifier: MIT
// Narrows a seam by samples, and corrects the colors of its line. seam_correct assumes that colors
// change in the middle of the remaining interval. This function's unit of length is half a cell of
// the last level, so that positions are integers. Negative corrections wrap around in the unsigned
// sums, which are correct at the end.
#include "refine/seam.h"

float seam_contrast(const Seam *seam)
{
    const int area = (seam->high - seam->low) * seam->side;
    return seam_difference(&seam->ends[0], &seam->ends[1]) * (float)area /
           (REFINE_GRID * REFINE_GRID);
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

// Returns whether a sample clearly resembles `end`, and not `other`.
static bool is_like(const SampleData *sample, const SampleData *end, const SampleData *other)
{
    return sample->signature == end->signature &&
           (end->signature != other->signature ||
            2 * seam_difference(sample, end) < seam_difference(sample, other));
}

// The sample of the end `assumed` was taken in the cell beyond the line. Replaces it by `sample`,
// which was taken at the line's border. If `sample` resembles the sample of the nearest cell, there
// is no seam between the two samples.
static void take_border(Seam *seam, const SampleData *sample)
{
    if (is_like(sample, &seam->ends[SEAM_END_LAST - seam->assumed], &seam->ends[seam->assumed]))
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

// An interval of the line and its sample. The unit of length is half a cell of the last level.
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
    const uint32_t side = seam->side, length = GROUP_SIDE * side;
    if (seam->assumed != SEAM_ENDS || seam->low == seam->high)
        return;
    const uint32_t step = seam->low + seam->high + 1u;
    const uint32_t begin = seam->from == 0 ? 0 : 2u * seam->from + 1;
    const uint32_t end = seam->to + 1u == length ? 2 * length : 2u * seam->to + 1;
    const Stretch parts[2] = {{begin, step, &seam->ends[0]}, {step, end, &seam->ends[1]}};
    const uint32_t first = seam->line * (seam->stride == 1 ? GROUP_SIDE : 1u);
    for (uint32_t i = 0; i < GROUP_SIDE; i++)
        for (int part = 0; part < 2; part++) {
            const uint32_t cell = first + i * seam->stride;
            const uint32_t held = overlap(&parts[part], 2 * side * i, 2 * side * (i + 1));
            if (held > 0)
                correct_cell(&parts[part], &cells[cell], held * side, sums[cell]);
        }
}
