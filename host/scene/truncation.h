// SPDX-License-Identifier: MIT
// Scene -> how far colors can be off because rays of some level see the background: colors are at
// most 1, so that the error is at most the weight that a ray of that level can have left.
#pragma once

#include "scene/scene.h"

// The largest error of any color where rays of max_level return the background.
double truncation_bound(const Scene *scene, uint32_t max_level);

// The smallest max_level whose bound is at most that; MAX_LEVEL_LIMIT where there is none below.
uint32_t truncation_level(const Scene *scene, double bound);
