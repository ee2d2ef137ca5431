// SPDX-License-Identifier: MIT
// Bvh and triangles -> the wide layout: nodes of eight children, and a block for every leaf.
#pragma once

#include "accel/flat.h"

// Fills flat's wides and blocks; the looks lose the marks of their triangles to the blocks.
// Without a tree, blocks hold the triangles in file order.
bool flat_wide_make(FlatScene *flat, const FlatSource *source, Error *error);
