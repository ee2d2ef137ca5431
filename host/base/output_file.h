// SPDX-License-Identifier: MIT
// A file that appears whole or not at all: it is written beside its final name and then renamed. A
// file cannot replace links, pipes and devices, so the finished bytes are copied into them.
#pragma once

#include "base/error.h"

typedef struct {
    const char *path; // the final name, "-" for standard output; borrowed
    char *temporary;  // the file to write to; owned
    bool replaces;    // renamed to path, not copied
} OutputFile;

// Creates an empty temporary file. The error message names the path.
bool output_file_begin(OutputFile *file, const char *path, Error *error);

// Moves the written file to its final name, or removes it if ok is false. Returns false if ok is
// false or the move fails; cause then holds the reason alone.
bool output_file_end(OutputFile *file, bool ok, Error *cause);

// Returns whether path seems writable. Callers check this before long work, so that none is lost.
bool output_file_check(const char *path, Error *error);
