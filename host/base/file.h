// SPDX-License-Identifier: MIT
// Whole files in memory, and paths relative to other files.
#pragma once

#include "base/error.h"

#include <stddef.h>
#include <stdio.h>

typedef struct {
    char *bytes; // size bytes and a terminating zero beyond them; owned
    size_t size;
} File;

// Reads all of path, a regular file or a pipe.  The message of a failure names the path and the
// system's reason.
bool file_read(File *file, const char *path, Error *error);

// Returns whether file_read can open path; false with file_read's message where it cannot.
bool file_check(const char *path, Error *error);

// The same of a stream, to its end; name is what messages call it.
bool file_read_stream(File *file, FILE *stream, const char *name, Error *error);

void file_free(File *file);

// Whether path ends in ending, ".mtl" for one, in letters of either case, behind something else.
bool file_has_ending(const char *path, const char *ending);

// Returns path as seen from the folder of the file beside: beside's folder and path joined, or
// path itself when it is absolute.  The caller frees it; NULL when memory ran out.
char *file_path_beside(const char *beside, const char *path, Error *error);
