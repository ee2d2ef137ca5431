// SPDX-License-Identifier: MIT
// Random numbers that are the same everywhere and always: splitmix64 (Steele, Lea and Flood, "Fast
// splittable pseudorandom number generators", 2014).
#pragma once

#include "base/vec.h"

#include <stdint.h>

typedef struct {
    uint64_t state; // any value is a seed
} Random;

static inline uint64_t random_bits(Random *random)
{
    random->state += 0x9e3779b97f4a7c15u;
    uint64_t bits = random->state;
    bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
    bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
    return bits ^ (bits >> 31);
}

// In [low, high).
static inline double random_between(Random *random, double low, double high)
{
    return low + (high - low) * ((double)(random_bits(random) >> 11) * 0x1p-53);
}

// Below count, which is at least 1.
static inline uint32_t random_below(Random *random, uint32_t count)
{
    return (uint32_t)(((random_bits(random) >> 32) * count) >> 32);
}

// In the cube [-half_side, half_side)^3.
static inline Vec3 random_in_cube(Random *random, double half_side)
{
    const double x = random_between(random, -half_side, half_side);
    const double y = random_between(random, -half_side, half_side);
    const double z = random_between(random, -half_side, half_side);
    return vec3(x, y, z);
}
