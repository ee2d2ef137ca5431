// SPDX-License-Identifier: MIT
// The table of options -> completions for zsh.
#pragma once

#include <stdio.h>

void zsh_write(FILE *stream);
