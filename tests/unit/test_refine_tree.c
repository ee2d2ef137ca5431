// SPDX-License-Identifier: MIT
// Tests the neighbors of cells in a refined picture, and its largest size.
#include "refine/refine_tree.h"

#include "unit/cmocka_all.h"

// Subdivides one of two pixels, and its right middle cell. All samples are taken.
static void make_tree(RefineTree *tree)
{
    Error error = {0};
    assert_true(refine_tree_make(tree, 2, 1, &error));
    assert_true(refine_tree_cut_pixel(tree, 0, 0, &error));
    assert_true(refine_tree_cut_cell(tree, 1, 5, &error));
    tree->traced = 3;
}

TEST(a_cell_beyond_the_pixel_is_the_pixel_beside)
{
    FREED_BY(refine_tree_free) RefineTree tree;
    CellName name;
    make_tree(&tree);
    assert_true(refine_tree_neighbor(&tree, &tree.groups.data[2], SIDE_RIGHT, &name));
    assert_int_equal(name.group, 0);
    assert_int_equal(name.cell, 1);
}

TEST(cells_without_their_samples_are_no_neighbors_yet)
{
    FREED_BY(refine_tree_free) RefineTree tree;
    CellName name;
    Error error = {0};
    make_tree(&tree);
    assert_true(refine_tree_cut_pixel(&tree, 1, 0, &error));
    assert_false(refine_tree_neighbor(&tree, &tree.groups.data[2], SIDE_RIGHT, &name));
    tree.traced = 4;
    assert_true(refine_tree_neighbor(&tree, &tree.groups.data[2], SIDE_RIGHT, &name));
    assert_int_equal(name.group, 3);
    assert_int_equal(name.cell, 3);
}

// In 32 bits, the number of pixels wraps around to 0.
TEST(a_picture_past_the_numbers_of_its_pixels_is_refused)
{
    RefineTree tree;
    Error error = {0};
    assert_false(refine_tree_make(&tree, 65536, 65536, &error));
    assert_string_equal(error.text, "a picture of 65536 x 65536 pixels is too large to be refined");
    assert_null(tree.pixels);
}
