// SPDX-License-Identifier: MIT
// Checks that a surface is closed.
#pragma once

#include "surface.h"

// Returns whether every directed edge of the triangles has exactly one twin in the opposite
// direction and the enclosed volume is positive. Otherwise, or if memory runs out, fills error.
bool closed_check(const Surface *surface, const char *name, Error *error);
