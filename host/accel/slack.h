// SPDX-License-Identifier: MIT
// Grows boxes by the slack that makes the device's culling conservative (kernels/search.cl),
// rounded outward.
#pragma once

#include "accel/bvh.h"

// Grows each plane by BVH_SLACK times the box's largest coordinate.
Box slack_grow(const Box *box);
