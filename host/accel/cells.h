// SPDX-License-Identifier: MIT
// Sorts triangles into the cells of a grid. A node of very many triangles can then be divided many
// levels down by moving cells, not triangles.
#pragma once

#include "accel/bounds.h"
#include "base/thread_pool.h"

typedef struct {
    BuildItem *items;  // of each cell that is not empty: its bounds, number and weight
    uint32_t *starts;  // of each cell and one past the last: position of its first triangle
    uint32_t *numbers; // of the triangles, cell after cell
    uint32_t count;
} Cells;

// The triangles to sort.
typedef struct {
    const Triangles *triangles;
    const uint32_t *numbers;
    uint32_t count;
} CellSource;

// Makes the cells. Triangles keep their order within a cell. If all centers are equal, one cell
// holds all triangles.
bool cells_make(Cells *cells, const CellSource *source, ThreadPool *pool, Error *error);
void cells_free(Cells *cells);
