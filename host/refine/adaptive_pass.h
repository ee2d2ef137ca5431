// SPDX-License-Identifier: MIT
// One pass of adaptive anti-aliasing: the samples that were decided on, traced as one list.
#pragma once

#include "refine/adaptive.h"
#include "refine/seam_search.h"

// Takes one sample a pixel.
bool adaptive_pass_begin(Adaptive *adaptive, const RenderObserver *observer, Error *error);

// Traces the groups from `first` on, and what seams ask for; where the observer stops it, forgets
// the groups.
bool adaptive_pass_trace(Adaptive *adaptive, uint32_t first, const SeamSearch *search,
                         const RenderObserver *observer, Error *error);
