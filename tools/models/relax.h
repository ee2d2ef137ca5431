// SPDX-License-Identifier: MIT
// Better places for the vertices of a surface.
#pragma once

#include "surface.h"

// Evens the vertices out along the field's surface, puts them onto it, takes the normals from its
// gradient, and turns each quad so that it is cut along its better diagonal.  False only when
// memory runs out.
bool relax_surface(Surface *surface, const Model *model, Error *error);
