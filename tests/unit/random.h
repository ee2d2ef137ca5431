// SPDX-License-Identifier: MIT
// Reproducible random numbers.
#pragma once

#include <stdint.h>

// Returns a number in [0, 1).
static inline double random_unit(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-53;
}

static inline uint32_t random_below(uint64_t *state, uint32_t end)
{
    return (uint32_t)(random_unit(state) * end);
}
