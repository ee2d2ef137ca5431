// SPDX-License-Identifier: MIT
// The parts of flattening: shading data in file order, then either layout.
#pragma once

#include "accel/bvh.h"
#include "accel/flat.h"

// Fills flat's looks and normals, in file order: materials and normals beside the corners. A look
// holds its triangle's flags until the layout moves them.
bool flat_looks_make(FlatScene *flat, const FlatSource *source, Error *error);

// Fills the layout of pairs: a node with both children's boxes for every inner node, and the
// triangles in leaf order. The looks move into the triangles.
bool flat_pair_make(FlatScene *flat, const FlatSource *source, Error *error);

// Fills the wide layout: nodes of eight children, and a block for every leaf. The triangles' flags
// move from the looks to the blocks. Without a tree, blocks hold the triangles in file order.
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

// Stores the grown planes of a child in a node with `children` children, or, if box is NULL, planes
// that no ray hits. The low planes of all children precede the high ones, axis by axis.
void box_store(float *planes, uint32_t children, uint32_t child, const Box *box);
