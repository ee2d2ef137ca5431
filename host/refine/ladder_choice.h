// SPDX-License-Identifier: MIT
// Strata's fractions -> the pixels that advance to the next rung.
#pragma once

#include "refine/ladder_state.h"

// Fills ladder->chosen with the pixels that the strata's fractions select. The pixels with small
// requests come first. Stores the number of all these pixels in *count.
bool ladder_choose(Ladder *ladder, uint64_t *count, Error *error);
