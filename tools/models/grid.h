// SPDX-License-Identifier: MIT
// A model's field sampled on a regular grid.
#pragma once

#include "base/error.h"
#include "model.h"

#include <stddef.h>

typedef struct {
    Vec3 low;      // where sample 0 0 0 lies
    double cell;   // distance between neighboring samples before the taper
    double taper;  // the model's
    int size[3];   // samples along x, y, z
    float *values; // x runs fastest; negative is inside
} Grid;

static inline size_t grid_sample(const Grid *grid, int x, int y, int z)
{
    return ((size_t)z * (size_t)grid->size[1] + (size_t)y) * (size_t)grid->size[0] + (size_t)x;
}

// One past the last cell, a cell being numbered as the sample at its low corner.  The numbers of
// samples on the high faces wrap round to cells whose corners all lie on the grid's faces; those
// are all outside, so such a cell is never crossed.
size_t grid_cell_end(const Grid *grid);

// The signs at a cell's corners: bit 0 stands for +x, bit 1 for +y, bit 2 for +z of the corner's
// number, and the mask's bit of that number is set where the corner is inside.
unsigned grid_cell_mask(const Grid *grid, size_t cell);

static inline size_t grid_sample_count(const Grid *grid)
{
    return (size_t)grid->size[0] * (size_t)grid->size[1] * (size_t)grid->size[2];
}

// Where the point lies that many samples along x, y, z; whole numbers give the samples.
Vec3 grid_point(const Grid *grid, Vec3 at);

// The size of the cells at a point of the world, for a model.
double grid_cell_size(const Model *model, Vec3 point);

// Samples the model, then adds the few samples that make the inside well-composed, which
// surface_extract needs.  False when memory runs out or the model reaches the box's faces.
bool grid_make(Grid *grid, const Model *model, Error *error);
void grid_free(Grid *grid);
