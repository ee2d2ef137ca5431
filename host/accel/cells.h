// SPDX-License-Identifier: MIT
// Triangles -> the cells of a grid and the triangles in each, so that a node of very many triangles
// can be divided many levels down by moving cells, not triangles.
#pragma once

#include "accel/bounds.h"
#include "base/parallel.h"

typedef struct {
    BuildItem *items;  // of each cell that is not empty: its bounds, number and weight
    uint32_t *starts;  // of each cell and one past the last: place of its first triangle
    uint32_t *numbers; // of the triangles, cell after cell
    uint32_t count;
} Cells;

// Those of the triangles that are shared out.
typedef struct {
    const Triangles *triangles;
    const uint32_t *numbers;
    uint32_t count;
} CellSource;

// Triangles keep their order within a cell.  One cell holds all where the centers are the same.
bool cells_make(Cells *cells, const CellSource *source, Crew *crew, Error *error);
void cells_free(Cells *cells);
