// SPDX-License-Identifier: MIT
// The table of options -> --help.
#pragma once

#include <stdio.h>

// Writes what --help shows.
void options_write_help(FILE *stream);
