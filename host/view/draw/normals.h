// SPDX-License-Identifier: MIT
// Model -> its normals as lines: those of the vertices where triangles are smooth, else one in the
// middle of each triangle.
#pragma once

#include "view/draw/boxes.h"
#include "view/model.h"

// Fills an empty array, which is to be freed in either case, with lines from low to high, in the
// normalized frame.
bool normals_make(Boxes *lines, const Model *model, Error *error);
