// SPDX-License-Identifier: MIT
// The parts of flattening: shading data in file order, then either layout.
#pragma once

#include "accel/bvh.h"
#include "accel/flat.h"

// Fills flat's looks and normals, in file order. Each look also holds its triangle's flags until
// flat_pair_make or flat_wide_make moves them.
bool flat_looks_make(FlatScene *flat, const FlatSource *source, Error *error);

// Fills the pair layout: a BvhPair for every inner node or for a root that is a leaf, and the
// triangles in leaf order. The looks move into the triangles.
bool flat_pair_make(FlatScene *flat, const FlatSource *source, Error *error);

// Fills the wide layout: nodes of up to eight children, and blocks of triangles. The triangles'
// flags move from the looks to the blocks. Without a tree, both layouts keep the file's order.
bool flat_wide_make(FlatScene *flat, const FlatSource *source, Error *error);

// Operations on axis-aligned boxes.

// Returns half the surface area; zero for an empty box.
static inline float box_half_area(const Box *box)
{
    const float x = box->high[0] - box->low[0];
    const float y = box->high[1] - box->low[1];
    const float z = box->high[2] - box->low[2];
    return x >= 0 ? x * y + y * z + z * x : 0;
}

// Stores a child's box, grown by BVH_SLACK, in the planes of a node with room for `children`
// children. If box is NULL, no ray enters the stored box. On each axis, the low planes of all
// children precede the high ones.
void box_store(float *planes, uint32_t children, uint32_t child, const Box *box);
