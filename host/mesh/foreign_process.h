// SPDX-License-Identifier: MIT
// A file in another format than PLY -> the stream that the program which holds Assimp writes about
// it (foreign_stream.h), in a process of its own: what crashes there, hangs or wants the whole
// memory is one sentence here.
#pragma once

#include "base/file.h"

typedef struct {
    const char *program; // NULL: the one that belongs to this build
    double seconds;      // after which it is stopped, from its start
    size_t bytes;        // the most that it may write
} ForeignReader;

// The limits that suit any model that can be drawn.
extern const ForeignReader foreign_reader;

// Fills stream; false with a sentence about the file at path.
bool foreign_process_run(File *stream, const ForeignReader *reader, const char *path, Error *error);
