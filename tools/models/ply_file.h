// SPDX-License-Identifier: MIT
// Surface -> binary little-endian PLY file.
// Format: Greg Turk, "The PLY Polygon File Format", Stanford 1994.
#pragma once

#include "surface.h"

// Writes vertices (x y z nx ny nz, float; red green blue, uchar, unless color is NULL) and two
// triangles per quad. If the file cannot be written
// completely, returns false, and error receives the file's name and the system's reason.
bool ply_file_write(const Surface *surface, PointColor *color, const char *path, Error *error);
