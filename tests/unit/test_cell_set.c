// SPDX-License-Identifier: MIT
// Tests that sets contain exactly the added cells, and that widening matches its definition.
#include "refine/cell_set.h"
#include "unit/cmocka_all.h"
#include "unit/random.h"

#include <stdlib.h>

#define WIDTH  75
#define HEIGHT 20

TEST(cells_have_room_in_pixels_with_a_slot)
{
    FREED_BY(slots_free) Slots slots;
    Error error;
    assert_true(slots_make(&slots, WIDTH, HEIGHT, &error));
    FREED_BY(cell_set_free) CellSet set = cell_set_of(&slots, 9);
    slots_add(&slots, 4, 7);
    assert_true(cell_set_make_room(&set, &error));
    assert_true(cell_set_add(&set, 4 * 9 + 8, 7 * 9));
    assert_false(cell_set_add(&set, 4 * 9 + 8, 7 * 9));
    assert_false(cell_set_add(&set, 5 * 9, 7 * 9));
    slots_add(&slots, 5, 7);
    assert_false(cell_set_add(&set, 5 * 9, 7 * 9));
    assert_true(cell_set_make_room(&set, &error));
    assert_true(cell_set_add(&set, 5 * 9, 7 * 9));
    for (uint32_t row = 0; row < 9 * HEIGHT; row++)
        for (uint32_t column = 0; column < 9 * WIDTH; column++)
            assert_int_equal(cell_set_has(&set, column, row),
                             row == 63 && (column == 44 || column == 45));
    assert_false(cell_set_has(&set, UINT32_MAX, 63));
    assert_false(cell_set_has(&set, 44, UINT32_MAX));
    cell_set_clear_pixel(&set, 4, 7);
    assert_false(cell_set_has(&set, 44, 63));
    assert_true(cell_set_has(&set, 45, 63));
}

TEST(ranges_of_pixels_are_added_and_found_as_a_whole)
{
    FREED_BY(slots_free) Slots slots;
    Error error;
    assert_true(slots_make(&slots, WIDTH, HEIGHT, &error));
    FREED_BY(cell_set_free) CellSet set = cell_set_of(&slots, 1);
    assert_true(cell_set_make_room(&set, &error));
    for (uint32_t first = 0; first < WIDTH; first++)
        for (uint32_t end = first + 1; end <= WIDTH; end++) {
            pixel_set_add_range(&set, 3, first, end);
            for (uint32_t column = 0; column < WIDTH; column++)
                assert_int_equal(cell_set_has(&set, column, 3), column >= first && column < end);
            assert_true(pixel_set_has_all(&set, 3, first, end));
            assert_false(pixel_set_has_all(&set, 3, first, end + 1));
            assert_false(first > 0 && pixel_set_has_all(&set, 3, first - 1, end));
            pixel_set_clear_rows(&set, 3, 4);
        }
}

static bool holds_corner(const CellSet *set, uint32_t column, uint32_t row)
{
    return cell_set_has(set, column, row) && cell_set_has(set, column + 1, row) &&
           cell_set_has(set, column, row + 1) && cell_set_has(set, column + 1, row + 1);
}

static bool is_wide(const CellSet *set, uint32_t column, uint32_t row)
{
    bool wide = false;
    for (uint32_t y = row - 2; y != row + 2; y++)
        for (uint32_t x = column - 2; x != column + 2; x++)
            wide = wide || holds_corner(set, x, y);
    return wide;
}

TEST(pixels_are_wide_beside_a_corner_that_is_all_held)
{
    FREED_BY(slots_free) Slots slots;
    Error error;
    uint64_t random = 1;
    assert_true(slots_make(&slots, WIDTH, HEIGHT, &error));
    FREED_BY(cell_set_free) CellSet set = cell_set_of(&slots, 1), wide = cell_set_of(&slots, 1);
    assert_true(cell_set_make_room(&set, &error) && cell_set_make_room(&wide, &error));
    for (int trial = 0; trial < 200; trial++) {
        for (int i = 0; i < 10 + 3 * trial; i++)
            cell_set_add(&set, random_below(&random, WIDTH), random_below(&random, HEIGHT));
        for (uint32_t row = 0; row < HEIGHT; row++)
            pixel_set_widen_row(&wide, &set, row);
        for (uint32_t row = 0; row < HEIGHT; row++)
            for (uint32_t column = 0; column < WIDTH; column++)
                assert_int_equal(cell_set_has(&wide, column, row), is_wide(&set, column, row));
        pixel_set_clear_rows(&set, 0, HEIGHT);
    }
}
