// SPDX-License-Identifier: MIT
// A scene of everything that clrt.h can fill in, and the file of the same numbers.
#pragma once

#include <clrt.h>

extern const ClrtCamera filled_cameras[2];

ClrtScene *filled_make(void);

// Writes the file, with its meshes beside it, into a new folder; the path is freed by
// filled_remove, which removes that too.
char *filled_write(void);
void filled_remove(char *path);
