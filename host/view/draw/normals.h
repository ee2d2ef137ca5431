// SPDX-License-Identifier: MIT
// Model -> its normals as lines: at the vertices of smooth objects, otherwise in the middle of each
// triangle.
#pragma once

#include "view/draw/boxes.h"
#include "view/model.h"

// Fills an empty array with lines from low to high, in the normalized frame.  The caller frees it,
// also after a failure.
bool normals_make(Boxes *lines, const Model *model, Error *error);
