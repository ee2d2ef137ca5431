// SPDX-License-Identifier: MIT
// Suggests a known word for a mistyped one.
#pragma once

#include <stddef.h>

// Returns the word with the smallest edit distance to the `length` characters of `text`. Returns
// NULL if all distances exceed half of `length`, or if `length` exceeds 24.
const char *word_nearest(const char *text, size_t length, const char *const *words, size_t count);
