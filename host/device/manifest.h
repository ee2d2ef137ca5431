// SPDX-License-Identifier: MIT
// A manifest lists the files that PoCL stores for one program, with their checksums. Each line is
// "CHECKSUM PATH", with a path relative to PoCL's folder. The first line of a manifest file is the
// checksum of all other lines.
#pragma once

#include "base/array.h"

#define MANIFEST_PATH_SIZE 2048

// PoCL stores a program as XX/Y.../program.bc and XX/Y.../KERNEL/SIZES/KERNEL.so.
#define PROGRAM_LEVEL 2 // depth of a program's folder below PoCL's folder
#define KERNEL_LEVEL  3 // depth of a kernel's file below its program's folder

// Growing text, zero-terminated after the first append.
typedef ARRAY(char) Lines;

// Returns false if memory runs out, and then leaves the lines unchanged.
bool lines_append(Lines *lines, const char *text);

// Returns all lines of a manifest file except the first line. Returns NULL if the file is missing
// or damaged. The caller frees the result.
char *manifest_read(const char *path);

// Returns whether the folder contains all listed files with their checksums.
bool manifest_holds(const char *lines, const char *folder);

// Appends a line for each file in folder/program. Returns false if reading or memory fails.
bool manifest_list(Lines *lines, const char *folder, const char *program);

// Writes a manifest file. If writing fails, no file remains.
void manifest_write(const char *path, const char *lines);
