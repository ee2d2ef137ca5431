// SPDX-License-Identifier: MIT
// Reproducible random numbers.
#pragma once

#include <stdint.h>

// Returns 64 random bits by splitmix64 (Steele, Lea and Flood, "Fast splittable pseudorandom number
// generators", 2014). Any state is a seed.
static inline uint64_t random_bits(uint64_t *state)
{
    *state += 0x9e3779b97f4a7c15u;
    uint64_t bits = *state;
    bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
    bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
    return bits ^ (bits >> 31);
}

// Returns a number in [0, 1).
static inline double random_unit(uint64_t *state)
{
    return (double)(random_bits(state) >> 11) * 0x1p-53;
}

// Returns a number in [low, high]. Rounding may yield high.
static inline double random_between(uint64_t *state, double low, double high)
{
    return low + (high - low) * random_unit(state);
}

// Returns an integer in [0, end). end must be at least 1.
static inline uint32_t random_below(uint64_t *state, uint32_t end)
{
    return (uint32_t)(((random_bits(state) >> 32) * end) >> 32);
}
