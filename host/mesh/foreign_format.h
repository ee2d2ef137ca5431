// SPDX-License-Identifier: MIT
// The endings of mesh files in other formats than PLY, which Assimp reads.  The ending alone
// decides: most of these formats have no mark that their files begin with.
#pragma once

#include <stdbool.h>
#include <stddef.h>

// In the order of the alphabet.
extern const char *const foreign_endings[];
extern const size_t foreign_ending_count;

// Whether the path ends in one of them, in letters of either case.
bool foreign_format_is(const char *path);
