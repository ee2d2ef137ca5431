// SPDX-License-Identifier: MIT
// A bundle of cables: long thin triangles oblique to the axes, whose boxes are mostly empty.
#pragma once

#include "surface.h"

// Makes a closed surface of 72 thousand triangles with normals. Returns false only if memory runs
// out.
bool cables_make(Surface *surface, Error *error);
