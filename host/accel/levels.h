// SPDX-License-Identifier: MIT
// How a tree spreads over its levels, for statistics.
#pragma once

#include "accel/bvh.h"

// Counts the inner nodes at every depth; the root, if it is one, is counts[0].
void levels_count(const Bvh *bvh, uint32_t counts[BVH_MAX_DEPTH]);
