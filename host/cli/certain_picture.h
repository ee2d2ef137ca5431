// SPDX-License-Identifier: MIT
// How certain the pixels of a picture are, and the picture with those repaired that fp64 can.
#pragma once

#include "cli/run.h"

// Fills the run's certainty and repairs its picture, which stands; notes the counts in its report.
// A picture that was stopped stays as it is, without any certain pixel.
bool certain_picture_make(Run *run, const CameraData *camera, Error *error);
