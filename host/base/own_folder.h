// SPDX-License-Identifier: MIT
// The folder of the running program, which opens its companion files from there.
#pragma once

#include <limits.h>
#include <stdbool.h>

// Fills folder with the folder of the program's file. Returns false if the system does not report
// it, as without /proc. There is no fallback: the current folder may hold anybody's files.
bool own_folder(char folder[PATH_MAX]);
