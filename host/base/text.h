// SPDX-License-Identifier: MIT
// New texts, the file name in a path, and the known word that is most like a mistyped one.
#pragma once

#include "base/error.h"

#include <stddef.h>

// Both functions return a new text, or NULL if memory runs out. The caller frees the text.
char *text_copy(const char *text, Error *error);
__attribute__((format(printf, 2, 3))) char *text_format(Error *error, const char *format, ...);

// Returns whether the `length` characters of `text` are the whole word.
bool text_is(const char *text, size_t length, const char *word);

// Returns the part of `path` after its last slash, or the whole path without a slash.
const char *text_file_name(const char *path);

// Returns the word with the smallest edit distance to the `length` characters of `text`. Returns
// NULL if all distances exceed half of `length`, or if `length` exceeds 24.
const char *word_nearest(const char *text, size_t length, const char *const *words, size_t count);
