// SPDX-License-Identifier: MIT
// A file that appears whole or not at all: it is written beside its final name and then renamed.
// Links, pipes and devices cannot be replaced by a file, so the finished bytes are copied into
// them.
#pragma once

#include "base/error.h"

typedef struct {
    const char *path; // the final name, "-" for standard output; borrowed
    char *temporary;  // where to write meanwhile; owned
    bool replaces;    // the one becomes the other
} OutputFile;

// Makes an empty file for the unfinished one.  The message of a failure names the path.
bool output_file_begin(OutputFile *file, const char *path, Error *error);

// Moves what was written to its place, or, where ok is false, away.  False, and the reason alone,
// where it was not ok or that failed.
bool output_file_end(OutputFile *file, bool ok, Error *cause);

// Whether a file can be written to path, as far as that shows beforehand: asked before the work, so
// that none is lost.
bool output_file_check(const char *path, Error *error);
