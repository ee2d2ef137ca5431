// SPDX-License-Identifier: MIT
// Sorts triangles into the cells of a grid. A builder can then divide a large node through many
// levels by moving cells instead of triangles.
#pragma once

#include "accel/bounds.h"
#include "base/parallel.h"

typedef struct {
    BuildItem *items;  // bounds, index and triangle count of each nonempty cell
    uint32_t *starts;  // by cell: where its triangles begin in numbers; the last is the end
    uint32_t *numbers; // triangle indices, cell by cell
    uint32_t count;
} Cells;

// The triangles to sort, by index.
typedef struct {
    const Triangles *triangles;
    const uint32_t *numbers;
    uint32_t count;
} CellSource;

// Makes the cells. Within a cell, triangles keep the order of source. If all centers are equal, one
// cell holds all triangles.
bool cells_make(Cells *cells, const CellSource *source, Crew *crew, Error *error);
void cells_free(Cells *cells);
