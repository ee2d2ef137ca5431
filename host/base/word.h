// SPDX-License-Identifier: MIT
// Guesses which known word a mistyped one was meant to be.
#pragma once

#include <stddef.h>

// The one of count words with the smallest edit distance to text, NULL where all are so far off
// that naming one would mislead.
const char *word_nearest(const char *text, size_t length, const char *const *words, size_t count);
