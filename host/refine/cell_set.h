// SPDX-License-Identifier: MIT
// Sets of cells of one level, with a bit per cell. Threads may add cells concurrently. To save
// memory, cells smaller than a pixel have room only in pixels that received a slot.
#pragma once

#include "base/array.h"

#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>

// Maps pixels to their slots. Slots are numbered from 1, and 0 means no slot.
typedef struct {
    uint32_t width, height;      // of the picture
    _Atomic uint32_t *of_pixels; // row by row
    _Atomic uint32_t count;
} Slots;

bool slots_make(Slots *slots, uint32_t width, uint32_t height, Error *error);
void slots_free(Slots *slots);

// Gives a pixel a slot. Call it at most once per pixel.
void slots_add(Slots *slots, uint32_t column, uint32_t row);

typedef struct {
    const Slots *slots;
    uint32_t scale; // cells along a pixel's side; 1 in a set of pixels
    union {
        _Atomic uint32_t *words;
        void *memory;
    };
    size_t count, capacity; // of words
} CellSet;

// Returns an empty set without room.
static inline CellSet cell_set_of(const Slots *slots, uint32_t scale)
{
    return (CellSet){.slots = slots, .scale = scale};
}

// Makes room for all pixels if scale is 1, otherwise for all pixels with a slot. Keeps the set's
// cells.
bool cell_set_make_room(CellSet *set, Error *error);
void cell_set_free(CellSet *set);

// Returns whether the cell of that column and row is in the set. Returns false for cells without
// room.
bool cell_set_has(const CellSet *set, uint32_t column, uint32_t row);

// Adds a cell if there is room. Returns whether the cell is new.
bool cell_set_add(CellSet *set, uint32_t column, uint32_t row);

// Removes all cells of a pixel.
void cell_set_clear_pixel(CellSet *set, uint32_t column, uint32_t row);

// The following functions require a set of pixels. Pixels first to end - 1 of the row must be
// inside the picture.
void pixel_set_add_range(CellSet *set, uint32_t row, uint32_t first, uint32_t end);

// Returns whether the set contains the whole range.
bool pixel_set_has_all(const CellSet *set, uint32_t row, uint32_t first, uint32_t end);

// Returns a bit for each of the 32 pixels of a row from left on. left is a multiple of 32.
uint32_t pixel_set_bits(const CellSet *set, uint32_t left, uint32_t row);

// Removes the pixels of rows top to bottom - 1.
void pixel_set_clear_rows(CellSet *set, uint32_t top, uint32_t bottom);

// A corner is full if the set contains all four pixels around it. Sets a row of wide to the pixels
// with a full corner, and to their eight neighbors.
void pixel_set_widen_row(CellSet *wide, const CellSet *set, uint32_t row);
