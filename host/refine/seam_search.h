// SPDX-License-Identifier: MIT
// A refined picture -> its seams, and the samples that place them.
#pragma once

#include "base/thread_pool.h"
#include "refine/refine_tree.h"

// Seams that a sample is wanted for.
typedef struct {
    ARRAY(uint32_t) asked; // by number, in order
    uint32_t seen;         // seams below are asked or have their place well enough
} SeamSearch;

// Opens the seams of the groups from `first` up to `end`, which have all their samples.
bool seam_search_open(RefineTree *tree, uint32_t first, uint32_t end, ThreadPool *pool,
                      Error *error);

// Asks for the seams with a contrast above the threshold, of those asked before and of new ones.
bool seam_search_ask(SeamSearch *search, const RefineTree *tree, float threshold, Error *error);

// Takes up the samples of the asked seams.
bool seam_search_take(const SeamSearch *search, RefineTree *tree, const SampleData *samples,
                      Error *error);

void seam_search_free(SeamSearch *search);
