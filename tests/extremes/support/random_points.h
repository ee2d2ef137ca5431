// SPDX-License-Identifier: MIT
// Random points and rotations.
#pragma once

#include "base/vec.h"
#include "unit/random.h"

typedef uint64_t Random; // any value is a seed

// Returns a point of the cube [-half_side, half_side]^3.
static inline Vec3 random_in_cube(Random *random, double half_side)
{
    const double x = random_between(random, -half_side, half_side);
    const double y = random_between(random, -half_side, half_side);
    return vec3(x, y, random_between(random, -half_side, half_side));
}

// Returns a vector of length 1.
static inline Vec3 random_direction(Random *random)
{
    return vec3_normalize(random_in_cube(random, 1));
}

// Stores randomly rotated axes, from a quaternion (Shoemake, "Uniform random rotations", 1992).
static inline void random_rotation(Random *random, Vec3 axes[3])
{
    double q[4], squared;
    do {
        squared = 0;
        for (int i = 0; i < 4; i++) {
            q[i] = random_between(random, -1, 1);
            squared += q[i] * q[i];
        }
    } while (squared > 1 || squared < 0.01);
    const double s = 2 / squared, w = q[0], x = q[1], y = q[2], z = q[3];
    axes[0] = vec3(1 - s * (y * y + z * z), s * (x * y + w * z), s * (x * z - w * y));
    axes[1] = vec3(s * (x * y - w * z), 1 - s * (x * x + z * z), s * (y * z + w * x));
    axes[2] = vec3(s * (x * z + w * y), s * (y * z - w * x), 1 - s * (x * x + y * y));
}

// Returns the point with these coordinates along the axes.
static inline Vec3 rotated(const Vec3 axes[3], Vec3 coordinates)
{
    return vec3_add(
        vec3_scale(axes[0], coordinates.x),
        vec3_add(vec3_scale(axes[1], coordinates.y), vec3_scale(axes[2], coordinates.z)));
}
