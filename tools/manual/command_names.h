// SPDX-License-Identifier: MIT
// The table of commands -> their names, as shells list them.
#pragma once

#include <stdio.h>

void command_names_write(FILE *stream, const char *separator);
