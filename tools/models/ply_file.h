// SPDX-License-Identifier: MIT
// Writes a surface as a binary little-endian PLY file (Greg Turk, "The PLY Polygon File Format",
// Stanford 1994).
#pragma once

#include "surface.h"

// Writes each vertex as floats x y z nx ny nz and, if color is not NULL, uchars red green blue.
// Writes each quad as two triangles. If the file cannot be written completely, returns false, and
// error receives the file's name and the system's reason.
bool ply_file_write(const Surface *surface, PointColor *color, const char *path, Error *error);
