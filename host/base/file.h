// SPDX-License-Identifier: MIT
// Whole files in memory, and paths relative to other files.
#pragma once

#include "base/error.h"

#include <stddef.h>
#include <stdio.h>

typedef struct {
    char *bytes; // `size` bytes and, except after foreign_run, a terminating zero; owned
    size_t size;
} File;

// A pipe may never end, so the functions below read at most this many bytes from it.
#define FILE_PIPE_MOST ((size_t)512 << 20)

// Reads the regular file or pipe at `path`. Fails if a file above FILE_PIPE_MOST bytes has holes.
// The error message names `path`, unless memory runs out.
bool file_read(File *file, const char *path, Error *error);

// Returns whether file_read can open `path`. If not, stores the error message of file_read.
bool file_check(const char *path, Error *error);

// Reads `stream` to its end. Error messages call the stream `name`.
bool file_read_stream(File *file, FILE *stream, const char *name, Error *error);

void file_free(File *file);

// Returns whether `path` ends in `ending`, such as ".mtl", after at least one other character.
// Ignores case.
bool file_has_ending(const char *path, const char *ending);

// Returns a copy of `path`. If `path` is relative, the copy begins with the folder of the file
// `beside`. The caller frees the copy, which is NULL if memory runs out.
char *file_path_beside(const char *beside, const char *path, Error *error);
