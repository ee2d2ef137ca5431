// SPDX-License-Identifier: MIT
// The files that Assimp may read for a model: its own and those in its folder or below. Each is
// read whole and once. Assimp may not write.
#pragma once

#include "base/array.h"
#include "base/file.h"

#include <assimp/cfileio.h>

typedef struct {
    char *path;
    File file;
} OpenedFile;

typedef struct {
    struct aiFileIO interface; // for Assimp; it points back to the files
    const char *model;         // path, with a folder
    ARRAY(OpenedFile) opened;  // the model's first, once it is opened
    size_t outside_count;      // number of requests for files outside of the folder
    char missing[256];         // the first material library that could not be opened, relative
                               // to the folder; "" without one
} Files;

// Initializes the files for the model at that path, which must outlive them.
void files_init(Files *files, const char *model);

// Reads the model; on failure returns false and the reason.
bool files_open_model(Files *files, Error *error);

// Limits this process: gives up file descriptors, later privileges, file writing, memory and time.
void limits_take(void);

// Raises the memory limit for a file of `bytes` bytes, up to the overall limit.
void limits_allow_file(size_t bytes);
