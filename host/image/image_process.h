// SPDX-License-Identifier: MIT
// Opens the module that calls OpenImageIO. Picture files may be hostile, so clrt-foreign reads them
// with this module in a separate process.
#pragma once

#include "image/image_module.h"
#include "image/stored_image.h"

typedef void ModuleFunction(void);

// Opens the module and returns its function `name`, which the caller casts to the right type.
// Returns NULL on failure.
ModuleFunction *open_module(const char *name, Error *cause);

typedef struct {
    const char *path, *format; // the file, and OpenImageIO's name of its format
    uint64_t bytes;            // size of the file
} ImageRequest;

// Reads the file in the given OpenImageIO format, and validates everything that clrt-foreign sends.
// On failure, returns false and stores the reason without the file name in *cause. The caller frees
// the image in both cases.
bool image_process_read(StoredImage *image, const ImageRequest *request, Error *cause);
