// SPDX-License-Identifier: MIT
// The order in which a triangle's corners are stored for the device (kernels/shared.h).
#pragma once

#include <stdbool.h>
#include <stdint.h>

typedef struct {
    uint8_t places[3]; // of the corners sorted by x, then y, then z
    bool reversed;     // sorting swaps front and back
} CornerOrder;

extern const CornerOrder corner_orders[8];

// Returns an index into corner_orders. Sorting by it gives the same three points for every order
// of the arguments.
uint8_t corner_order(const float *a, const float *b, const float *c);
