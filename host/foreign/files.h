// SPDX-License-Identifier: MIT
// The files that Assimp may read for a model: its own and those in its folder or below, whole and
// once, and nothing to write.
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
    ARRAY(OpenedFile) opened;  // the model's first, once it was opened
    size_t outside_count;      // how often a file outside of the folder was asked for
    char missing[256];         // the first material library that could not be opened, as seen
                               // from the folder; "" without one
} Files;

// The files for the model at that path, which is in use as long as they are.
void files_init(Files *files, const char *model);

// Reads the model; false with the reason where it cannot be.
bool files_open_model(Files *files, Error *error);
