// SPDX-License-Identifier: MIT
// Random rotations, as the three axes they turn x, y and z to.
#pragma once

#include "random.h"

void random_rotation(Random *random, Vec3 axes[3]);

// The point with these coordinates along the axes.
Vec3 rotated(const Vec3 axes[3], Vec3 coordinates);
