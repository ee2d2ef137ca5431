// SPDX-License-Identifier: MIT
// JSON values -> a file.
#pragma once

#include "base/error.h"

#include <jansson.h>

// JSON is UTF-8 and a path need not be: bytes past ASCII in one that is not become '?'.
json_t *json_file_path(const char *path);

// Writes root, with sorted keys, at path ("-": standard output), and gives it up.
bool json_file_write(json_t *root, const char *path, Error *error);
