// SPDX-License-Identifier: MIT
// Tests for each cell of a grid whether an outline touches the cell or contains the cell's center.
#include "refine/outline.h"
#include "unit/cmocka_all.h"
#include "unit/random.h"

#define TRIALS 3000
#define GRID   12

static const CellGrid grid = {27, 1.0 / 27, {GRID, GRID + 1}, {0, 0}};

// Returns a random triangle. Some triangles extend beyond the grid, and some are slivers.
static Outline random_triangle(uint64_t *state)
{
    Outline outline = {.count = 3};
    const double size = random_between(state, 1, 200);
    const double x = random_between(state, -50, 400), y = random_between(state, -50, 400);
    const double flat = random_between(state, 0, 1) < 0.5 ? 0.02 : 1;
    for (int i = 0; i < 3; i++) {
        const double across = size * random_between(state, -1, 1);
        outline.corners[i][0] = x + across;
        outline.corners[i][1] = y + across + flat * size * random_between(state, -1, 1);
    }
    outline_complete(&outline);
    return outline;
}

static double side_of(const double from[2], const double to[2], double x, double y)
{
    return (to[0] - from[0]) * (y - from[1]) - (to[1] - from[1]) * (x - from[0]);
}

static bool holds(const Outline *outline, double x, double y)
{
    int left = 0;
    for (uint32_t i = 0; i < 3; i++)
        left += side_of(outline->corners[i], outline->corners[(i + 1) % 3], x, y) >= 0;
    return left == 0 || left == 3;
}

// Returns whether the line through side i separates the square from the triangle.
static bool parted_by(const Outline *outline, uint32_t i, double x, double y, double size)
{
    const double *from = outline->corners[i], *to = outline->corners[(i + 1) % 3];
    const double *third = outline->corners[(i + 2) % 3];
    const double sign = side_of(from, to, third[0], third[1]) > 0 ? 1 : -1;
    bool parted = true;
    for (int corner = 0; corner < 4; corner++)
        parted = parted &&
                 sign * side_of(from, to, x + size * (corner % 2), y + size * (corner / 2)) < 0;
    return parted;
}

static bool meets_square(const Outline *outline, double x, double y, double size)
{
    const OutlineBox *box = &outline->box;
    bool meets = box->low[0] <= x + size && box->high[0] >= x && box->low[1] <= y + size &&
                 box->high[1] >= y;
    for (uint32_t i = 0; i < 3; i++)
        meets = meets && !parted_by(outline, i, x, y, size);
    return meets;
}

static bool is_in(CellRange range, uint32_t number)
{
    return number >= range.first && number < range.end;
}

TEST(exactly_the_cells_that_it_meets_are_touched)
{
    uint64_t random = 1;
    for (int trial = 0; trial < TRIALS; trial++) {
        const Outline outline = random_triangle(&random);
        const CellRange rows = cells_along(&outline.box, &grid, 1, CELL_AREA);
        for (uint32_t row = 0; row < grid.counts[1]; row++) {
            const CellRange columns = outline_cells(&outline, &grid, row, CELL_AREA);
            for (uint32_t column = 0; column < grid.counts[0]; column++)
                assert_int_equal(
                    is_in(rows, row) && is_in(columns, column),
                    meets_square(&outline, column * grid.side, row * grid.side, grid.side));
        }
    }
}

TEST(exactly_the_samples_that_it_holds_are_sampled)
{
    uint64_t random = 2;
    for (int trial = 0; trial < TRIALS; trial++) {
        const Outline outline = random_triangle(&random);
        const CellRange rows = cells_along(&outline.box, &grid, 1, CELL_CENTER);
        for (uint32_t row = 0; row < grid.counts[1]; row++) {
            const CellRange columns = outline_cells(&outline, &grid, row, CELL_CENTER);
            for (uint32_t column = 0; column < grid.counts[0]; column++)
                assert_int_equal(
                    is_in(rows, row) && is_in(columns, column),
                    holds(&outline, (column + 0.5) * grid.side, (row + 0.5) * grid.side));
        }
    }
}

TEST(a_triangle_is_as_thick_as_its_inner_disk)
{
    Outline outline = {.count = 3, .corners = {{0, 0}, {30, 0}, {0, 40}}};
    outline_complete(&outline);
    assert_true(outline_is_thinner(&outline, 20.001));
    assert_false(outline_is_thinner(&outline, 19.999));
}

TEST(a_polygon_is_never_said_to_be_thicker_than_it_is)
{
    Outline strip = {.count = 4, .corners = {{0, 0}, {300, 400}, {292, 406}, {-8, 6}}};
    outline_complete(&strip);
    assert_true(outline_is_thinner(&strip, 10.001));
    assert_false(outline_is_thinner(&strip, 5));
}

TEST(corners_counter_clockwise_as_seen_give_a_negative_area)
{
    const Outline outline = {.count = 4, .corners = {{0, 0}, {0, 5}, {7, 5}, {7, 0}}};
    assert_true(outline_signed_area(&outline) == -70);
}
