// SPDX-License-Identifier: MIT
// Meshes -> the cells around their thin parts (thin_parts.h).
#pragma once

#include "refine/thin_cells.h"

bool thin_triangles_find(ThinParts *parts, const ThinSource *source, Error *error);
