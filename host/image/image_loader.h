// SPDX-License-Identifier: MIT
// Finds and opens the OpenImageIO module, once, on a thread beside the tracing.
#pragma once

#include "base/error.h"
#include "image/image_module.h"

// Starts opening the module; calls after the first do nothing.
void image_loader_start(void);

// Waits for the module and returns its function, NULL where it could not be opened.
ImageModuleWrite *image_loader_finish(Error *error);
