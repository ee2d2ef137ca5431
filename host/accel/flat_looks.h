// SPDX-License-Identifier: MIT
// Scene -> what shading a triangle takes beside its corners: materials and normals, in file order.
#pragma once

#include "accel/flat.h"

// Fills flat's looks and normals.  A look carries the marks of its triangle until the layout moves
// them to their place.
bool flat_looks_make(FlatScene *flat, const FlatSource *source, Error *error);
