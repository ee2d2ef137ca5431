// SPDX-License-Identifier: MIT
// Bvh -> the boxes that one level of it shows.
#pragma once

#include "accel/bvh.h"
#include "base/array.h"

typedef ARRAY(Box) Boxes;

// How many levels of inner nodes there are.
uint32_t boxes_levels(const Bvh *bvh);

// Fills an empty array: level 0 gives the boxes of the leaves, others those of the inner nodes at
// that level, the root being at 1.  To be freed in either case.
bool boxes_make(Boxes *boxes, const Bvh *bvh, uint32_t level, Error *error);
void boxes_free(Boxes *boxes);
