// SPDX-License-Identifier: MIT
// A model's field sampled on a regular grid.
#pragma once

#include "base/error.h"
#include "model.h"

#include <stddef.h>

typedef struct {
    Vec3 low;      // the position of sample 0 0 0
    double cell;   // distance between neighboring samples before the taper
    double taper;  // the model's
    int size[3];   // samples along x, y, z
    float *values; // x runs fastest; negative is inside
} Grid;

static inline size_t grid_sample(const Grid *grid, int x, int y, int z)
{
    return ((size_t)z * (size_t)grid->size[1] + (size_t)y) * (size_t)grid->size[0] + (size_t)x;
}

// Returns the index after the last cell. A cell has the index of the sample at its low corner.
// Samples on the grid's high faces have cells too. The corners of these cells wrap around to other
// faces. All samples on the grid's faces are outside, so the surface never crosses these cells.
size_t grid_cell_end(const Grid *grid);

// Returns a mask of the cell's corners that are inside. In a corner's number, bit 0 means +x, bit 1
// means +y and bit 2 means +z.
unsigned grid_cell_mask(const Grid *grid, size_t cell);

static inline size_t grid_sample_count(const Grid *grid)
{
    return (size_t)grid->size[0] * (size_t)grid->size[1] * (size_t)grid->size[2];
}

// Returns the position that is `at` cells away from the grid's first sample, along each axis.
// Integers give the positions of samples.
Vec3 grid_point(const Grid *grid, Vec3 at);

// Returns the size of a model's cells at a point in world coordinates.
double grid_cell_size(const Model *model, Vec3 point);

// Samples the model. A few outside samples become inside ones, so that the inside is well-composed
// (grid.c), as surface_extract requires. Returns false if memory is exhausted or the model touches
// the box's faces.
bool grid_make(Grid *grid, const Model *model, Error *error);
void grid_free(Grid *grid);
