// SPDX-License-Identifier: MIT
// Lists the files that PoCL stores for one program, with their checksums. The lines are "CHECKSUM
// PATH", with paths relative to PoCL's folder. The first line of a manifest file is the checksum
// of all other lines.
#pragma once

#include "base/array.h"

#define MANIFEST_PATH_SIZE 2048

// PoCL's folder has a folder at the second level for each program: XX/Y.../program.bc and
// XX/Y.../KERNEL/SIZES/KERNEL.so.
#define PROGRAM_LEVEL 2 // depth of a program's folder below PoCL's
#define KERNEL_LEVEL  3 // depth of a kernel's file below its program's folder

// Growing text, terminated after the first append.
typedef ARRAY(char) Lines;

// Returns false if memory runs out and leaves the lines unchanged.
bool lines_append(Lines *lines, const char *text);

// Returns the lines of a manifest file, which the caller frees; NULL if it is missing or damaged.
char *manifest_read(const char *path);

// Returns whether all files of the lines are in the folder and have their checksums.
bool manifest_holds(const char *lines, const char *folder);

// Appends the lines of all files in folder/program. Returns false if memory runs out.
bool manifest_list(Lines *lines, const char *folder, const char *program);

// Writes a manifest file. Leaves no file on failure.
void manifest_write(const char *path, const char *lines);
