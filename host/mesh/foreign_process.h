// SPDX-License-Identifier: MIT
// Runs the program that holds Assimp on a file and collects the stream that it writes
// (foreign_stream.h). The program is a process of its own. If it crashes, hangs or exhausts
// memory, clrt prints one error message.
#pragma once

#include "base/child_process.h"

// Returns whether the path has the extension of a mesh format that Assimp reads, in either case.
// The extension alone decides, because most of these formats have no magic bytes.
bool foreign_format_is(const char *path);

typedef struct {
    const char *program; // NULL: the program that belongs to this build
    ChildLimits limits;
} ForeignReader;

// Limits that suit any model that clrt can render.
extern const ForeignReader foreign_reader;

// Fills stream; on failure returns false with a message about the file at path.
bool foreign_process_run(File *stream, const ForeignReader *reader, const char *path, Error *error);
