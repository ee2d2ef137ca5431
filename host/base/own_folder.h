// SPDX-License-Identifier: MIT
// Where the program that runs lies, for what belongs to it and is opened from there.
#pragma once

#include <limits.h>
#include <stdbool.h>

// Leaves the folder of the program's file; false where the system does not tell, as without /proc.
// Nothing stands for it then: the current folder may hold anybody's files.
bool own_folder(char folder[PATH_MAX]);
