// SPDX-License-Identifier: MIT
// Meshes -> the pixels that their thin parts touch, and probes (thin_parts.h).
#pragma once

#include "refine/thin_places.h"

bool thin_triangles_find(ThinParts *parts, const ThinSource *source, Error *error);
