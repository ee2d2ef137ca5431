// SPDX-License-Identifier: MIT
// Runs OpenImageIO in child processes. One process writes pictures and lives as long as this one:
// it loads the 261 libraries concurrently, whereas in one process, the locks of the dynamic loader
// and of the address space would block compiling and tracing meanwhile. Reading takes a process per
// file, with limited memory and time and without writing, because the file may be hostile.
#pragma once

#include "image/image_module.h"
#include "image/stored_image.h"

// Starts the process that writes. Only main may call it, before other threads start. A failure only
// costs time.
void image_process_start(void);

// Writes the picture, in that process if it runs. On failure, returns false and the reason alone.
bool image_process_write(const ImageModulePicture *picture, Error *cause);

// Reads the file in the given OpenImageIO format, and trusts nothing that the process sends. On
// failure returns false and the reason alone. The caller frees the image in both cases.
bool image_reader_run(StoredImage *image, const char *path, const char *format, Error *cause);

typedef void ModuleFunction(void);

// Opens the module that holds OpenImageIO. Returns its function of that name, to be cast to its
// type; NULL if the module cannot be opened.
ModuleFunction *open_module(const char *name, Error *cause);
