// SPDX-License-Identifier: MIT
// Converts a Bvh and its triangles to the wide layout: nodes of eight children, and a block for
// every leaf.
#pragma once

#include "accel/flat.h"

// Fills flat's wides and blocks. The triangles' flags move from the looks to the blocks. Without a
// tree, blocks hold the triangles in file order.
bool flat_wide_make(FlatScene *flat, const FlatSource *source, Error *error);
