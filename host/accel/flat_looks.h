// SPDX-License-Identifier: MIT
// Builds the shading data of a scene's triangles beside their corners: materials and normals, in
// file order.
#pragma once

#include "accel/flat.h"

// Fills flat's looks and normals. A look holds its triangle's flags until the layout moves them.
bool flat_looks_make(FlatScene *flat, const FlatSource *source, Error *error);
