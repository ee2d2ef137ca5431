// SPDX-License-Identifier: MIT
// The extensions of mesh files that Assimp reads. The extension alone decides, because most of
// these formats have no magic bytes.
#pragma once

#include <stdbool.h>
#include <stddef.h>

// In alphabetical order.
extern const char *const foreign_endings[];
extern const size_t foreign_ending_count;

// Returns whether the path ends in one of them, in either case.
bool foreign_format_is(const char *path);
