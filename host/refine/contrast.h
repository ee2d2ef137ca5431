// SPDX-License-Identifier: MIT
// Decides which cells are subdivided: cells whose color differs too much from a neighbor's, and
// cells with thin parts.
//
// The threshold limits the possible error of the pixel's color. A small cell covers less of the
// pixel than a large one, so it may differ more from its neighbors. A difference between a small
// and a large cell may therefore exceed only the large cell's limit.
//
// Invariant: cells are subdivided in the order of their ranges, by one thread. The indices of
// groups therefore do not depend on the number of threads.
#pragma once

#include "base/thread_pool.h"
#include "refine/thin_parts.h"

// A rule by which cells are selected. A cell's contrast is its largest color difference from a
// neighbor, multiplied by the cell's fraction of the pixel. The contrast of a whole pixel is
// doubled, and the contrast of a smaller cell is halved.
typedef struct {
    const ThinParts *thin_parts;
    float threshold; // cells with more contrast are subdivided
} CutRule;

// Subdivides the pixels that the rule selects. Pixels are visited block by block, so that
// consecutive samples are near each other.
bool contrast_cut_pixels(RefineTree *tree, const CutRule *rule, ThreadPool *pool, Error *error);

// Subdivides the selected cells of the groups from `first` on, and larger selected cells beside
// these groups.
bool contrast_cut_groups(RefineTree *tree, const CutRule *rule, uint32_t first, ThreadPool *pool,
                         Error *error);
