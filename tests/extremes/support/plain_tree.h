// SPDX-License-Identifier: MIT
// Trees that ignore where triangles lie: valid, slow, and of shapes that no builder makes.
#pragma once

#include "accel/bvh.h"

// Halves the triangles in file order until leaves hold that many at most.
void plain_tree_halves(Bvh *bvh, const Triangles *triangles, uint32_t leaf_size);

// A chain of BVH_MAX_DEPTH levels: each parts one triangle from all the others, and the last leaf
// holds the rest.
void plain_tree_chain(Bvh *bvh, const Triangles *triangles);
