// SPDX-License-Identifier: MIT
// Whole files in memory, and paths relative to other files.
#pragma once

#include "base/error.h"

#include <stddef.h>
#include <stdio.h>

typedef struct {
    char *bytes; // `size` bytes and a terminating zero; owned
    size_t size;
} File;

// Reads the regular file or pipe at path. The error message names path and the system's reason.
bool file_read(File *file, const char *path, Error *error);

// Returns whether file_read can open path. If not, the error message is the same as file_read's.
bool file_check(const char *path, Error *error);

// Reads a stream to its end. Error messages call the stream `name`.
bool file_read_stream(File *file, FILE *stream, const char *name, Error *error);

void file_free(File *file);

// Returns whether path ends in `ending`, such as ".mtl", and is longer. Ignores case.
bool file_has_ending(const char *path, const char *ending);

// Returns path with the folder of the file `beside` in front, unless path is absolute. The caller
// frees the result. Returns NULL if memory runs out.
char *file_path_beside(const char *beside, const char *path, Error *error);
