// SPDX-License-Identifier: MIT
// A bundle of cables. Its triangles are long, thin and oblique to the axes, so their boxes are
// mostly empty.
#pragma once

#include "surface.h"

// Makes a closed surface of 72 thousand triangles with normals. Returns false only if memory runs
// out.
bool cables_make(Surface *surface, Error *error);
