// SPDX-License-Identifier: MIT
// The table of options -> --help.
#pragma once

#include <stdio.h>

// Writes the text of --help.
void options_write_help(FILE *stream);
