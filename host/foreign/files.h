// SPDX-License-Identifier: MIT
// The files that Assimp may read for a model: the model file, and files in its folder or below.
// Assimp cannot write files.
#pragma once

#include "base/array.h"
#include "base/file.h"

#include <assimp/cfileio.h>

typedef struct {
    char *path;
    File file;
} OpenedFile;

typedef struct {
    struct aiFileIO interface; // passed to Assimp; its UserData points to this struct
    const char *model;         // the model's path, which includes a folder
    ARRAY(OpenedFile) opened;  // the files read so far; the model file is first
    size_t outside_count;      // number of requests for files outside of the folder
    char missing[256];         // path of the first material library that was not opened, or ""
} Files;

// Initializes *files for the model at the path `model`, which *files borrows.
void files_init(Files *files, const char *model);

// Reads the model file. Returns false on failure.
bool files_open_model(Files *files, Error *error);
