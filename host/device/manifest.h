// SPDX-License-Identifier: MIT
// Lists the files that PoCL keeps of one program, with their checksums: lines "CHECKSUM PATH",
// paths relative to PoCL's folder.  A file of them begins with the checksum of all lines, on a
// line.
#pragma once

#include "base/array.h"

#define MANIFEST_PATH_SIZE 2048

// PoCL's folder has one of two levels for each program: XX/Y.../program.bc and
// XX/Y.../KERNEL/SIZES/KERNEL.so.
#define PROGRAM_LEVEL 2 // of a program's folder below PoCL's
#define KERNEL_LEVEL  3 // of a kernel's file below its program's folder

// Text that grows, terminated once something was appended.
typedef ARRAY(char) Lines;

// False leaves the lines as they were: memory ran out.
bool lines_append(Lines *lines, const char *text);

// Returns the lines of a file, which the caller frees; NULL where there is none or it is damaged.
char *manifest_read(const char *path);

// Returns whether all files of the lines are in the folder and have their checksums.
bool manifest_holds(const char *lines, const char *folder);

// Appends the lines of all files in folder/program; false where memory ran out.
bool manifest_list(Lines *lines, const char *folder, const char *program);

// Leaves nothing where the file cannot be written.
void manifest_write(const char *path, const char *lines);
