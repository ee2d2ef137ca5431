// SPDX-License-Identifier: MIT
// The module that holds OpenImageIO, and a process that reads files by it, with limited memory and
// time and without writing, because the file may be hostile.
#pragma once

#include "image/image_module.h"
#include "image/stored_image.h"

typedef void ModuleFunction(void);

// Opens the module. Returns its function of that name, to be cast to its type; NULL if the module
// cannot be opened.
ModuleFunction *open_module(const char *name, Error *cause);

// Reads the file in the given OpenImageIO format, and trusts nothing that the process sends. On
// failure returns false and the reason alone. The caller frees the image in both cases.
bool image_process_read(StoredImage *image, const char *path, const char *format, Error *cause);
