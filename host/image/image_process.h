// SPDX-License-Identifier: MIT
// A second process that holds OpenImageIO and writes pictures. It loads the 261 libraries
// concurrently. In one process, the locks of the dynamic loader and of the address space would
// block compiling and tracing meanwhile.
#pragma once

#include "base/error.h"
#include "image/image_module.h"

// Starts the process, which ends with this one. Only main may call it, before other threads start.
// A failure only costs time.
void image_process_start(void);

// Writes the picture, in that process if it runs. On failure, returns false and the reason alone.
bool image_process_write(const ImageModulePicture *picture, Error *cause);
