// SPDX-License-Identifier: MIT
// Tests seams with color steps at known positions.
#include "refine/refine_tree.h"
#include "unit/cmocka_all.h"

#define SIDE  27u
#define LINE  (GROUP_SIDE * SIDE)
#define AREA  (2.0 * SIDE * SIDE) // twice a cell's area, as in ColorSum
#define STEPS 4294967296.0

static SampleData seen(float color, uint32_t signature)
{
    return (SampleData){{color, color, color}, signature};
}

// Returns a sample that is dark before the step and bright from the step on.
static SampleData step_at(uint32_t place, uint32_t step)
{
    return place < step ? seen(0.25f, 1) : seen(0.75f, 2);
}

static void see_cells(SampleData cells[GROUP_CELLS], uint32_t step)
{
    for (uint32_t cell = 0; cell < GROUP_CELLS; cell++)
        cells[cell] = step_at(SIDE / 2 + cell % GROUP_SIDE * SIDE, step);
}

static double sum_of_line(const Seam *seam, const SampleData cells[GROUP_CELLS])
{
    ColorSum sums[GROUP_CELLS];
    for (uint32_t cell = 0; cell < GROUP_CELLS; cell++)
        for (int channel = 0; channel < 3; channel++)
            sums[cell][channel] = 2 * SIDE * SIDE * seam_color_steps(cells[cell].color[channel]);
    seam_correct(seam, cells, sums);
    return (double)(sums[0][0] + sums[1][0] + sums[2][0]) / STEPS / AREA;
}

// Returns the seam between the first two cells.
static Seam first_seam(const SampleData cells[GROUP_CELLS])
{
    return (Seam){.stride = 1,
                  .side = SIDE,
                  .from = SIDE / 2,
                  .to = SIDE / 2 + SIDE,
                  .low = SIDE / 2,
                  .high = SIDE / 2 + SIDE,
                  .ends = {cells[0], cells[1]},
                  .assumed = SEAM_ENDS};
}

TEST(samples_place_a_step_between_two_cells_wherever_it_lies)
{
    for (uint32_t step = SIDE / 2 + 1; step <= SIDE / 2 + SIDE; step++) {
        SampleData cells[GROUP_CELLS];
        uint32_t place[2], samples = 0;
        see_cells(cells, step);
        Seam rest, seam = first_seam(cells);
        for (; seam_asks(&seam, place); samples++) {
            const float before = seam_contrast(&seam);
            const SampleData sample = step_at(place[0], step);
            assert_false(seam_take(&seam, &sample, &rest));
            assert_true(seam_contrast(&seam) < 0.7f * before);
        }
        const double expected = (0.25 * step + 0.75 * (LINE - step)) / SIDE;
        assert_true(samples <= 5);
        assert_true(sum_of_line(&seam, cells) - expected < 1e-6);
        assert_true(sum_of_line(&seam, cells) - expected > -1e-6);
    }
}

static Seam border_seam(const SampleData cells[GROUP_CELLS])
{
    Seam seam = first_seam(cells);
    seam.from = seam.low = 0;
    seam.to = seam.high = SIDE / 2;
    seam.assumed = SEAM_END_FIRST;
    seam.ends[0] = seen(0.75f, 2);
    seam.ends[1] = cells[0];
    return seam;
}

TEST(a_color_beyond_the_border_counts_only_after_a_sample_inside_has_it)
{
    SampleData cells[GROUP_CELLS];
    uint32_t place[2];
    Seam rest;
    see_cells(cells, LINE);
    Seam inside = border_seam(cells), outside = inside;
    assert_true(sum_of_line(&inside, cells) == 0.75);
    assert_true(seam_asks(&inside, place));
    assert_int_equal(place[0], 0);
    seam_take(&inside, &inside.ends[0], &rest);
    assert_true(sum_of_line(&inside, cells) > 0.75 + 0.5 * 6 / SIDE);
    assert_true(sum_of_line(&inside, cells) < 0.75 + 0.5 * 8 / SIDE);
    seam_take(&outside, &cells[0], &rest);
    assert_true(sum_of_line(&outside, cells) == 0.75);
    assert_false(seam_asks(&outside, place));
}

TEST(a_third_surface_between_two_makes_a_seam_on_either_side)
{
    const SampleData third = seen(1, 3);
    SampleData cells[GROUP_CELLS];
    see_cells(cells, 30);
    Seam rest, seam = first_seam(cells);
    assert_true(seam_take(&seam, &third, &rest));
    assert_int_equal(seam.to, 26);
    assert_int_equal(rest.from, 26);
    assert_int_equal(rest.to, 40);
    assert_memory_equal(&seam.ends[1], &third, sizeof third);
    assert_memory_equal(&rest.ends[0], &third, sizeof third);
    const double both = sum_of_line(&seam, cells) + sum_of_line(&rest, cells);
    const double expected = 2 * (0.25 + 0.75 + 0.75) + (7 * 0.75 + 7 * 0.25) / SIDE;
    assert_true(both - expected < 0.02 && both - expected > -0.02);
}
