// SPDX-License-Identifier: MIT
// A picture with as many samples per pixel as it needs.
#pragma once

#include "cli/run.h"

// Draws the run's picture and stores its cost in the report.
bool refined_picture_draw(Run *run, const CameraData *camera, const RenderObserver *observer,
                          Error *error);
