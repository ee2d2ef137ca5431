// SPDX-License-Identifier: MIT
// Bvh -> the boxes at one of its levels.
#pragma once

#include "accel/bvh.h"
#include "base/array.h"

typedef ARRAY(Box) Boxes;

// Returns the number of levels of inner nodes.
uint32_t boxes_levels(const Bvh *bvh);

// Fills an empty array.  Level 0 selects the leaves; other levels select the inner nodes there,
// with the root at 1.  The caller frees the boxes, also after a failure.
bool boxes_make(Boxes *boxes, const Bvh *bvh, uint32_t level, Error *error);
void boxes_free(Boxes *boxes);
