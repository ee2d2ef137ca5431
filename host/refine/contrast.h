// SPDX-License-Identifier: MIT
// Decides which cells are subdivided: cells whose color differs from a neighbor's, and cells with
// thin parts.
//
// The threshold limits the possible error of the pixel's color, so a small cell may differ more
// from its neighbors than a large one. A small cell can also show that a larger neighbor is too
// coarse.
//
// Invariant: threads only list cells, range by range. One thread then subdivides them in the order
// of the ranges, so the groups have the same numbers for every number of threads.
#pragma once

#include "base/thread_pool.h"
#include "refine/thin_parts.h"

// A cell's contrast is its largest color difference from a neighbor, multiplied by the
// cell's fraction of the pixel, and doubled between pixels or halved inside one.
typedef struct {
    const ThinParts *thin_parts;
    float threshold; // cells with more contrast are subdivided
} CutRule;

// Subdivides the pixels that the rule selects, block by block, so that consecutive samples are near
// each other.
bool contrast_cut_pixels(RefineTree *tree, const CutRule *rule, ThreadPool *pool, Error *error);

// Subdivides selected cells of the groups from first on, and larger selected cells beside these
// groups.
bool contrast_cut_groups(RefineTree *tree, const CutRule *rule, uint32_t first, ThreadPool *pool,
                         Error *error);
