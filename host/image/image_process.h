// SPDX-License-Identifier: MIT
// A second process that holds OpenImageIO and writes pictures.  It loads the 261 libraries beside
// everything else: within one process the dynamic loader's lock and the address space's would
// make compiling and tracing wait for that.
#pragma once

#include "base/error.h"
#include "image/image_module.h"

// Starts the process, which lasts no longer than this one.  For main alone, while no other thread
// runs.  Where it fails, nothing is lost but time.
void image_process_start(void);

// Writes the picture, in that process where there is one; false and the reason alone where it
// cannot.
bool image_process_write(const ImageModulePicture *picture, Error *cause);
