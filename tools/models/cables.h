// SPDX-License-Identifier: MIT
// A bundle of cables: long thin triangles that lie across the axes, which boxes hold badly.
#pragma once

#include "surface.h"

// Makes a closed surface of about 72 thousand triangles with normals. Returns false only if memory
// runs out.
bool cables_make(Surface *surface, Error *error);
