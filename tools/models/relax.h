// SPDX-License-Identifier: MIT
// Improves the positions of a surface's vertices.
#pragma once

#include "surface.h"

// Distributes the vertices evenly on the field's surface, computes normals from the field's
// gradient, and orders the corners of each quad so that it is cut along its better diagonal.
// Returns false only if memory runs out.
bool relax_surface(Surface *surface, const Model *model, Error *error);
