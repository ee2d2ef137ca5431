// SPDX-License-Identifier: MIT
// The first cause of a failure, as one sentence for the user. Functions that fail return false or
// NULL, and fill an Error. Assertions catch programming errors. If a function fails to make, open
// or read a value, the caller may free the value, but need not. Headers state exceptions to this
// rule.
#pragma once

#include <stdbool.h>

typedef struct {
    char text[4096]; // empty without a failure; long enough for most build logs
} Error;

// Replaces each byte of control characters by '?', because terminals interpret them and names of
// files may contain them. The text is UTF-8. Keeps line feeds and tabs.
void text_hide_controls(char *text);

// Records the message after text_hide_controls, and returns false, so that a caller can `return
// error_set(...)`. Does not replace a recorded message, because the first cause is the most
// informative.
__attribute__((format(printf, 2, 3))) bool error_set(Error *error, const char *format, ...);

// Calls error_set with a message about a failed allocation of `bytes` bytes.
bool error_out_of_memory(Error *error, unsigned long long bytes);
