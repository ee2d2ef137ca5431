// SPDX-License-Identifier: MIT
// Meshes -> the pixels that their thin parts touch, and probes (thin_parts.h).
#pragma once

#include "refine/refine_setup.h"
#include "refine/thin_places.h"

// Finds the thin triangles in the frame. Without `has_probes`, finds only the pixels that they
// touch.
bool thin_triangles_find(ThinParts *parts, const RefineSetup *setup, const FrameData *frame,
                         bool has_probes, Error *error);
