// SPDX-License-Identifier: MIT
// A picture of pixel centers -> the stratum of each pixel on rung 0.
#pragma once

#include "refine/ladder_state.h"

// Assigns all pixels to strata of rung 0. The pixels' centers must be drawn.
bool ladder_enter(Ladder *ladder, Error *error);
