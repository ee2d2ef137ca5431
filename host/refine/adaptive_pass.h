// SPDX-License-Identifier: MIT
// One pass of adaptive anti-aliasing traces the requested samples as one list.
#pragma once

#include "refine/adaptive.h"
#include "refine/seam_search.h"

// Takes one sample per pixel.
bool adaptive_pass_begin(Adaptive *adaptive, const RenderObserver *observer, Error *error);

// Traces the groups from `first` on and the samples that seams need. If the observer stops it,
// removes these groups.
bool adaptive_pass_trace(Adaptive *adaptive, uint32_t first, const SeamSearch *search,
                         const RenderObserver *observer, Error *error);
