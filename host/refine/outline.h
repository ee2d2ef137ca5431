// SPDX-License-Identifier: MIT
// Convex polygons in the picture -> the cells they touch, those whose samples they hold, and how
// thick they are.  Lengths are those of cells of the last level.
#pragma once

#include <stdbool.h>
#include <stdint.h>

// A triangle that five planes cut has no more.
#define OUTLINE_CORNERS 8

typedef struct {
    double low[2], high[2];
} OutlineBox;

typedef struct {
    uint32_t count;
    double corners[OUTLINE_CORNERS][2]; // in their order around it
    double slopes[OUTLINE_CORNERS];     // of the sides from each to the next: x by y
    OutlineBox box;                     // around it
} Outline;

// A picture's cells of one level: squares, with their samples in the middle.
typedef struct {
    double side, per_length; // its inverse
    uint32_t counts[2];      // of columns and of rows
} CellGrid;

typedef struct {
    uint32_t first, end;
} CellRange;

// Finds slopes and box from the corners.
void outline_complete(Outline *outline);

// Of numbers no larger than pictures; the library's are calls.
static inline int64_t outline_floor(double value)
{
    const int64_t whole = (int64_t)value;
    return whole - (value < (double)whole);
}

static inline uint32_t outline_limit(int64_t value, uint32_t most)
{
    return value > 0 ? (value < most ? (uint32_t)value : most) : 0;
}

// The cells from the one with `low` to the one with `high`.
static inline CellRange cells_touched(double low, double high, double per_length, uint32_t count)
{
    return (CellRange){outline_limit(outline_floor(low * per_length), count),
                       outline_limit(outline_floor(high * per_length) + 1, count)};
}

// Those with their middles in between.
static inline CellRange cells_sampled(double low, double high, double per_length, uint32_t count)
{
    return (CellRange){outline_limit(-outline_floor(0.5 - low * per_length), count),
                       outline_limit(outline_floor(high * per_length - 0.5) + 1, count)};
}

// The cells that a box touches, and those whose samples it holds.
static inline CellRange box_touched(const OutlineBox *box, const CellGrid *grid, int axis)
{
    return cells_touched(box->low[axis], box->high[axis], grid->per_length, grid->counts[axis]);
}

static inline CellRange box_sampled(const OutlineBox *box, const CellGrid *grid, int axis)
{
    return cells_sampled(box->low[axis], box->high[axis], grid->per_length, grid->counts[axis]);
}

// Twice its area: negative where its corners go counter-clockwise as seen, with y downward.
double outline_signed_area(const Outline *outline);

// Whether no disk of that diameter fits into it.  Of what has more than three corners this may be
// said where the largest disk is up to twice as wide.
bool outline_is_thinner(const Outline *outline, double diameter);

// The cells of a row that it touches, and those whose samples it holds.
CellRange outline_touched(const Outline *outline, const CellGrid *grid, uint32_t row);
CellRange outline_sampled(const Outline *outline, const CellGrid *grid, uint32_t row);
