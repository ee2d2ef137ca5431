// SPDX-License-Identifier: MIT
// Finds the seams of a refined picture, and lists the seams that need samples.
#pragma once

#include "refine/refine_tree.h"

// The seams that need a sample.
typedef struct {
    ARRAY(uint32_t) asked; // indices in ascending order
    uint32_t seen;         // seams with a lower index are listed, or precise enough
} SeamSearch;

// Adds the seams of groups from first on, except on the last level. All groups must have samples.
bool seam_search_open(RefineTree *tree, uint32_t first, Error *error);

// Lists the seams that a sample may narrow and whose contrast exceeds the threshold. Examines only
// listed and new seams.
bool seam_search_ask(SeamSearch *search, const RefineTree *tree, float threshold, Error *error);

// Updates the listed seams with their samples.
bool seam_search_take(const SeamSearch *search, RefineTree *tree, const SampleData *samples,
                      Error *error);

void seam_search_free(SeamSearch *search);
