// SPDX-License-Identifier: MIT
// Three comparisons, usually of x alone, form an index into a table. A branch on each comparison
// would be mispredicted half the time.
#include "accel/corner_order.h"

// Bit 0 of the index: the second corner precedes the first. Bit 1: the third precedes the second.
// Bit 2: the third precedes the first. Indices 3 and 4 are contradictory.
const CornerOrder corner_orders[8] = {
    [0] = {{0, 1, 2}, false}, [1] = {{1, 0, 2}, true},  [2] = {{0, 2, 1}, true},
    [5] = {{1, 2, 0}, false}, [6] = {{2, 0, 1}, false}, [7] = {{2, 1, 0}, true}};

static int precedes(const float *a, const float *b)
{
    if (a[0] != b[0])
        return a[0] < b[0];
    return a[1] != b[1] ? a[1] < b[1] : a[2] < b[2];
}

uint8_t corner_order(const float *a, const float *b, const float *c)
{
    const int has_equal = (a[0] == b[0]) | (b[0] == c[0]) | (c[0] == a[0]);
    if (has_equal)
        return (uint8_t)(precedes(b, a) | precedes(c, b) << 1 | precedes(c, a) << 2);
    return (uint8_t)((b[0] < a[0]) | (c[0] < b[0]) << 1 | (c[0] < a[0]) << 2);
}
