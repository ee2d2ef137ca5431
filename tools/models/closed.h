// SPDX-License-Identifier: MIT
// Proof that a surface is closed.
#pragma once

#include "surface.h"

// True when every directed edge of the triangles has exactly one twin in the opposite direction
// and the volume enclosed is positive; false with a sentence if not, or when memory runs out.
bool closed_check(const Surface *surface, const char *name, Error *error);
