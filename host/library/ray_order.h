// SPDX-License-Identifier: MIT
// The caller's rays -> the order in which the device traces them. The order changes no bit of the
// hits.
#pragma once

#include "library/ray_batch.h"

// Returns the length of a row if the rays form a grid, otherwise 0. In a grid, the points at t = 1
// advance in one direction and jump back at the end of each row.
size_t ray_order_width(const ClrtRays *rays);

// Fills batch->order for a part. In a grid with rows of `width` rays, consecutive entries form
// blocks of 64 rays. Rows that fill no block come last. If `width` is 0, the numbers ascend.
void ray_order_fill(RayBatch *batch, size_t width);
