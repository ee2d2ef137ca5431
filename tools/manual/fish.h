// SPDX-License-Identifier: MIT
// The table of options -> completions for fish.
#pragma once

#include <stdio.h>

void fish_write(FILE *stream);
