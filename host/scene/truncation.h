// SPDX-License-Identifier: MIT
// Bounds the color error of a maximum ray level, because rays of that level see the background.
// Colors are at most 1, so the error is at most the remaining weight of a ray of that level.
#pragma once

#include "scene/scene.h"

// Returns the largest error of any color if rays of max_level return the background.
double truncation_bound(const Scene *scene, uint32_t max_level);

// Returns the smallest max_level whose error is at most bound; MAX_LEVEL_LIMIT if none is smaller.
uint32_t truncation_level(const Scene *scene, double bound);
