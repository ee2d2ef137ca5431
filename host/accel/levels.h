// SPDX-License-Identifier: MIT
// The distribution of a tree's nodes over its levels, for statistics.
#pragma once

#include "accel/bvh.h"

// Counts the inner nodes at every depth. counts[0] is the root's level.
void levels_count(const Bvh *bvh, uint32_t counts[BVH_MAX_DEPTH]);
