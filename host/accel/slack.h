// SPDX-License-Identifier: MIT
// Boxes as the device culls by them: grown by the slack that makes culling conservative
// (kernels/traverse.cl) and rounded outward.
#pragma once

#include "accel/bvh.h"

// Grows each plane by BVH_SLACK times the box's largest coordinate.
Box slack_grow(const Box *box);
