// SPDX-License-Identifier: MIT
// Improves the positions of a surface's vertices.
#pragma once

#include "surface.h"

// Evens out the vertices on the field's surface, and computes normals from the field's gradient. At
// creases that the cells cannot resolve, vertices can be a fraction of a cell off the surface.
// These vertices get the mean normal of their quads. Orders each quad's corners so that the quad is
// cut along its better diagonal. Returns false only if memory runs out.
bool relax_surface(Surface *surface, const Model *model, Error *error);
