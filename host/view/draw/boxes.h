// SPDX-License-Identifier: MIT
// Boxes and lines for LineView: Bvh -> the boxes at one of its levels; Model -> its normals.
#pragma once

#include "accel/bvh.h"
#include "base/array.h"
#include "view/model.h"

typedef ARRAY(Box) Boxes;

// Returns the number of levels of inner nodes.
uint32_t boxes_levels(const Bvh *bvh);

// Fills an empty array.  Level 0 selects the leaves; other levels select the inner nodes there,
// with the root at 1.  The caller frees the boxes, also after a failure.
bool boxes_make(Boxes *boxes, const Bvh *bvh, uint32_t level, Error *error);
void boxes_free(Boxes *boxes);

// The normals are at the vertices of smooth objects, otherwise in the middle of each triangle.
//
// Fills an empty array with lines from low to high, in the normalized frame.  The caller frees it,
// also after a failure.
bool normals_make(Boxes *lines, const Model *model, Error *error);
