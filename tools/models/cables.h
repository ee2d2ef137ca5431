// SPDX-License-Identifier: MIT
// A bundle of cables: long thin triangles that lie across the axes, which boxes hold badly.
#pragma once

#include "surface.h"

// About 72 thousand triangles, closed, with normals.  False only when memory runs out.
bool cables_make(Surface *surface, Error *error);
