// SPDX-License-Identifier: MIT
// Computes the certainty of each pixel and repairs pixels in fp64.
#pragma once

#include "cli/run.h"

// Fills the run's certainty, repairs its finished picture and stores the counts in its report.  A
// stopped picture stays unchanged, without any certified pixel.
bool certain_picture_make(Run *run, const CameraData *camera, Error *error);
