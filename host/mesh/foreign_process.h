// SPDX-License-Identifier: MIT
// Runs clrt-foreign, which contains Assimp, on a file and collects its output (foreign_stream.h).
// If clrt-foreign crashes, hangs or exhausts memory, clrt prints one error message.
#pragma once

#include "base/child_process.h"

// Returns whether clrt-foreign reads files with the path's extension, ignoring case.
// The extension alone decides, because most of Assimp's formats have no magic bytes.
bool foreign_format_is(const char *path);

typedef struct {
    const char *program; // NULL for this build's clrt-foreign
    ChildLimits limits;
} ForeignReader;

// The defaults: this build's clrt-foreign, and the same limits for every model.
extern const ForeignReader foreign_reader;

// Fills stream; on failure returns false with a message about the file at path.
bool foreign_process_run(File *stream, const ForeignReader *reader, const char *path, Error *error);
