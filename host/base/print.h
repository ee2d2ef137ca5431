// SPDX-License-Identifier: MIT
// Prints texts.
#pragma once

#include <stdio.h>

// Prints as fprintf does, and replaces control characters as text_hide_controls does.
__attribute__((format(printf, 2, 3))) void print_text(FILE *stream, const char *format, ...);
