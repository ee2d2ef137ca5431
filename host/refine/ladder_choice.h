// SPDX-License-Identifier: MIT
// Strata's fractions -> the pixels that advance to the next rung.
#pragma once

#include "refine/ladder_state.h"

// Seeds of a pixel's hashes: SCRAMBLE_SEED for its samples, RUNG_SEED + rung for its selection on a
// rung.
#define SCRAMBLE_SEED 0
#define RUNG_SEED     1

uint64_t ladder_hash(uint32_t pixel, uint64_t seed);

// Fills ladder->chosen with the pixels that the strata's fractions select, and stores their number.
bool ladder_choose(Ladder *ladder, uint64_t *count, Error *error);
