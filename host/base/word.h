// SPDX-License-Identifier: MIT
// Suggests a known word for a mistyped one.
#pragma once

#include <stddef.h>

// Returns the word with the smallest edit distance to text, or NULL if no word is near enough for a
// useful suggestion.
const char *word_nearest(const char *text, size_t length, const char *const *words, size_t count);
