// SPDX-License-Identifier: MIT
// New groups of cells -> their seams, and the seams that need another sample.
#pragma once

#include "refine/refine_tree.h"

// The seams that need a sample.
typedef struct {
    ARRAY(uint32_t) asked; // indices in ascending order
    uint32_t seen;         // all seams with lower indices are in `asked` or need no sample
} SeamSearch;

// Adds the seams of the groups from `first` on, except on the last level. All cells of these groups
// must have samples.
bool seam_search_open(RefineTree *tree, uint32_t first, Error *error);

// Lists the seams that need a sample: their contrast exceeds the threshold, and another sample may
// narrow them. Examines only new seams and the seams of the previous list.
bool seam_search_ask(SeamSearch *search, const RefineTree *tree, float threshold, Error *error);

// Updates the listed seams with their samples.
bool seam_search_take(const SeamSearch *search, RefineTree *tree, const SampleData *samples,
                      Error *error);

void seam_search_free(SeamSearch *search);
