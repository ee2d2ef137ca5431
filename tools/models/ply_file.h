// SPDX-License-Identifier: MIT
// Surface -> binary little-endian PLY file.
// Format: Greg Turk, "The PLY Polygon File Format", Stanford 1994.
#pragma once

#include "surface.h"

// Writes vertices (x y z nx ny nz, float) and two triangles for each quad.  False when the file
// cannot be written in full; the message names it and the system's reason.
bool ply_file_write(const Surface *surface, const char *path, Error *error);
