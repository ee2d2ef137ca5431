// SPDX-License-Identifier: MIT
// Reads a PLY file into a Mesh: ascii, or binary of either byte order. Format: Greg Turk, "The PLY
// Polygon File Format", Stanford 1994.
#pragma once

#include "base/error.h"
#include "mesh/mesh.h"

#include <stdbool.h>

// Fills mesh from the `size` bytes of a PLY file. Messages call the file `name`. The parser reads
// vertex x y z nx ny nz and the list vertex_indices (or vertex_index) of face and tristrips, and
// skips all other elements and properties. Polygons become fans of triangles. Triangles with two
// equal corners are dropped and counted. Returns false on truncated, inconsistent, non-finite or
// out-of-range data, and if a file without triangles has elements that the parser skips. The
// message gives the line or, in a binary body, the byte offset. The parser allocates elements only
// if the file is long enough for them.
typedef bool PlyParse(Mesh *mesh, const char *bytes, size_t size, const char *name, Error *error);
PlyParse ply_parse;

// ply_parse for geometry checks. Accepts non-finite and out-of-range positions and normals, and
// counts them in mesh. Also counts the triangles dropped because of bad positions.
PlyParse ply_parse_tolerantly;
