// SPDX-License-Identifier: MIT
// Sets of a picture's cells of one level, a bit each, which threads may fill together.  Below
// pixels there is room for the cells of those pixels alone that have a slot.
#pragma once

#include "base/array.h"

#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>

// Which pixels have a slot, and which: counted from 1, 0 for none.
typedef struct {
    uint32_t width, height;      // of the picture
    _Atomic uint32_t *of_pixels; // row by row
    _Atomic uint32_t count;
} Slots;

bool slots_make(Slots *slots, uint32_t width, uint32_t height, Error *error);
void slots_free(Slots *slots);

// Gives a pixel a slot.  Only one thread asks for one for the same pixel, and only once.
void slots_add(Slots *slots, uint32_t column, uint32_t row);

typedef struct {
    const Slots *slots;
    uint32_t scale; // cells along a pixel's side: 1 for a set of pixels
    union {
        _Atomic uint32_t *words;
        void *memory;
    };
    size_t count, capacity; // of words
} CellSet;

// An empty set, without any room.
static inline CellSet cell_set_of(const Slots *slots, uint32_t scale)
{
    return (CellSet){.slots = slots, .scale = scale};
}

// Makes room for all pixels, or for those that have a slot by now; what is there stays.
bool cell_set_make_room(CellSet *set, Error *error);
void cell_set_free(CellSet *set);

// By column and row among the picture's cells; cells without room are in no set.
bool cell_set_has(const CellSet *set, uint32_t column, uint32_t row);

// Adds a cell if there is room, and returns whether it is new.
bool cell_set_add(CellSet *set, uint32_t column, uint32_t row);

// Takes all cells of a pixel out.
void cell_set_clear_pixel(CellSet *set, uint32_t column, uint32_t row);

// Of sets of pixels: adds the pixels of a row from `first` to before `end`, which are in the
// picture; and tells whether all of them are there.
void pixel_set_add_range(CellSet *set, uint32_t row, uint32_t first, uint32_t end);
bool pixel_set_has_all(const CellSet *set, uint32_t row, uint32_t first, uint32_t end);

// Of the 32 pixels of a row from `left` on, a multiple of 32, those in the set: a bit for each.
uint32_t pixel_set_bits(const CellSet *set, uint32_t left, uint32_t row);

// Takes out the pixels of rows from `top` to before `bottom`.
void pixel_set_clear_rows(CellSet *set, uint32_t top, uint32_t bottom);

// Makes a row of `wide` hold the pixels that have, or are beside one that has, a corner of which
// all four pixels are in the set.
void pixel_set_widen_row(CellSet *wide, const CellSet *set, uint32_t row);
