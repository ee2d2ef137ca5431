// SPDX-License-Identifier: MIT
// Rays in rows -> an order in which beams trace them faster. Programs list the rays of a picture
// row by row, but 64 rays of a square share more nodes than 64 rays of a row. The order changes no
// bit of the hits.
#pragma once

#include "library/clrt.h"

// Returns the length of the rows if the rays form a grid. The points at t = 1 then lead in one
// direction until they return at the end of a row. Returns 0 for other rays.
size_t ray_grid_width(const ClrtRays *rays);

// Fills order with the numbers 0 to count - 1, of which each 64 are a block of the grid. Numbers
// outside complete blocks come last. Without a width, the numbers ascend.
void ray_grid_order(uint32_t *order, size_t count, size_t width);
