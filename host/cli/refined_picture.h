// SPDX-License-Identifier: MIT
// A picture whose pixels get as many samples as they need.
#pragma once

#include "cli/run.h"

// Draws the run's picture, and leaves in its report what that took.
bool refined_picture_draw(Run *run, const CameraData *camera, const RenderObserver *observer,
                          Error *error);
