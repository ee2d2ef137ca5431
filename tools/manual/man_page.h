// SPDX-License-Identifier: MIT
// The table of options and a page with gaps -> clrt(1).
#pragma once

#include <stdbool.h>
#include <stdio.h>

// Copies the template at path and fills the lines %SYNOPSIS%, %COMMANDS%, %OPTIONS%, %CHANNELS%,
// %CLASSES% and %KEYS%. Returns false if the template cannot be read.
bool man_page_write(FILE *stream, const char *path);
