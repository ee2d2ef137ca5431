// SPDX-License-Identifier: MIT
// A regular output file appears complete or not at all. clrt writes a temporary file beside the
// final name and then renames it. Renaming would replace links, pipes and devices, so clrt copies
// the finished bytes into them.
#pragma once

#include "base/error.h"

#include <stdio.h>

typedef struct {
    const char *path; // the final name, "-" for standard output; borrowed
    char *temporary;  // path of the file to write; owned
    int lock;         // the temporary file, open and locked, so that no other run removes it
    bool replaces;    // the temporary file is renamed, not copied
} OutputFile;

// Creates an empty temporary file. The error message names `path` or, if the temporary file is in
// another folder, the temporary file.
bool output_file_begin(OutputFile *file, const char *path, Error *error);

// If `ok`, renames or copies the temporary file to its final name. Otherwise, removes it and
// returns false. If renaming or copying fails, returns false and stores the reason in *cause,
// without the path. If `ok` is false and the temporary file is in another folder, appends this
// folder to *cause.
bool output_file_end(OutputFile *file, bool ok, Error *cause);

// Creates the file from the bytes that `write` writes to its stream. On failure, `write` must
// return false with the reason in *cause or errno. The error message names `path`.
typedef bool WriteStream(void *context, FILE *stream, Error *cause);
bool output_file_write(const char *path, WriteStream *write, void *context, Error *error);

// Returns whether `path` seems writable. Callers check this before long work. Also removes the
// temporary files that killed runs left in the folder of `path`, but files of other machines only
// after a day.
bool output_file_check(const char *path, Error *error);

// Copies the rest of `from` to `to`. Returns false on failure, with the reason in errno.
bool output_file_copy(FILE *from, FILE *to);
