// SPDX-License-Identifier: MIT
// The files that a run will read and write -> a message where an output would replace an input or
// another output.  Files are compared by identity, so that links to one file count as that file.
#pragma once

#include "base/array.h"

#include <stdint.h>

typedef enum { FILE_INPUT, FILE_OUTPUT } FileUse;

typedef struct {
    FileUse use;
    const char *role;       // how messages introduce the path, "--stats=" for one; borrowed
    char *path;             // as the user wrote it; owned
    uint64_t device, inode; // of the file or, where none exists yet, of its folder
    char *name;             // in that folder, NULL where the file exists; owned
} PlannedFile;

typedef struct {
    ARRAY(PlannedFile) list;
} FilePlan;

// Adds the file at path; "-" is standard input or output.  Pipes and devices are left out, since
// nothing replaces them, and so are inputs that do not exist.
bool file_plan_add(FilePlan *plan, FileUse use, const char *role, const char *path, Error *error);

// Returns false with a message that names both where two planned files are one file and at least
// one of them is an output.
bool file_plan_check(const FilePlan *plan, Error *error);

void file_plan_free(FilePlan *plan);
