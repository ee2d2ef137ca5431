// SPDX-License-Identifier: MIT
// Rays in rows -> an order that is faster to trace in beams, which have at most 64 rays. Programs
// list the rays of a picture row by row, but 64 rays of a square share more nodes than 64 rays of a
// row. The order changes no bit of the hits.
#pragma once

#include "library/clrt.h"

// Returns the length of the rows if the rays form a grid. In a grid, the points at t = 1 advance in
// one direction and jump back at the end of each row. Returns 0 for other rays.
size_t ray_grid_width(const ClrtRays *rays);

// Fills order with the numbers 0 to count - 1, in blocks of 64 rays of the grid. Rows too few for a
// block come last. If width is 0, the numbers ascend.
void ray_grid_order(uint32_t *order, size_t count, size_t width);
