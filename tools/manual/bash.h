// SPDX-License-Identifier: MIT
// The table of options -> completions for bash.
#pragma once

#include <stdio.h>

void bash_write(FILE *stream);
