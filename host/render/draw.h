// SPDX-License-Identifier: MIT
// Runs the tiles of a picture on the device (the drawing half of Renderer).
#pragma once

#include "render/renderer.h"

// Runs the kernel once over an empty tile, because some drivers finish compiling at the first run.
bool draw_warm_up(Renderer *renderer, Error *error);
