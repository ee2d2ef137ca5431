// SPDX-License-Identifier: MIT
// Writes JSON values to files.
#pragma once

#include "base/error.h"

#include <jansson.h>
#include <stdint.h>

// Returns path as a JSON string. In a path that is not UTF-8, bytes beyond ASCII become '?'.
json_t *json_file_path(const char *path);

json_t *json_count(uint64_t count);

// Returns null if value is not finite, because JSON has no infinity.
json_t *json_finite(double value);

// Writes root with sorted keys to path ("-": standard output), and releases root.
bool json_file_write(json_t *root, const char *path, Error *error);
