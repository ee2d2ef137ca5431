// SPDX-License-Identifier: MIT
// Boxes and lines for LineView: Bvh -> the boxes at one of its levels; Model -> its normals.
#pragma once

#include "accel/bvh.h"
#include "base/array.h"
#include "view/model.h"

typedef ARRAY(Box) Boxes;

// Returns the number of levels of inner nodes.
uint32_t boxes_levels(const Bvh *bvh);

// Fills an empty array with the boxes of a level: 0 for the leaves, 1 for the root, and higher
// levels for deeper inner nodes. The caller frees the boxes, also after a failure.
bool boxes_make(Boxes *boxes, const Bvh *bvh, uint32_t level, Error *error);
void boxes_free(Boxes *boxes);

// Fills an empty array with the normals of a model, as lines from low to high in the normalized
// frame. They start at the vertices of smooth objects, and at the centers of the triangles of other
// objects. The caller frees the array, also after a failure.
bool normals_make(Boxes *lines, const Model *model, Error *error);
