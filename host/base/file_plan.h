// SPDX-License-Identifier: MIT
// Checks that no output of a run replaces an input or another output. The check compares files by
// identity, so a link counts as the file that it points to.
#pragma once

#include "base/array.h"

#include <stdint.h>

typedef enum { FILE_INPUT, FILE_OUTPUT } FileUse;

typedef struct {
    FileUse use;
    const char *role;       // prefix of the path in messages, such as "--json="; borrowed
    char *path;             // as the user wrote it; owned
    uint64_t device, inode; // of the file or, for a new file, of its folder
    char *name;             // a new file's name in its folder; NULL for an existing file; owned
} PlannedFile;

typedef struct {
    ARRAY(PlannedFile) list;
} FilePlan;

// Adds the file at `path`; "-" is standard input or output. Ignores missing inputs. Ignores pipes
// and devices, because writing does not replace them. Returns false if memory runs out.
bool file_plan_add(FilePlan *plan, FileUse use, const char *role, const char *path, Error *error);

// Returns false if an output is also an input or another output. The message names both paths.
bool file_plan_check(const FilePlan *plan, Error *error);

void file_plan_free(FilePlan *plan);
