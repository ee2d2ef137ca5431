// SPDX-License-Identifier: MIT
// PLY file -> Mesh: ascii and binary of either byte order.
// Format: Greg Turk, "The PLY Polygon File Format", Stanford 1994.
#pragma once

#include "base/error.h"
#include "mesh/mesh.h"

// Fills mesh from the size bytes of a PLY file; name stands in messages.  Elements and properties
// other than vertex x y z nx ny nz and face vertex_indices (or vertex_index) are passed over,
// polygons become fans of triangles, triangles with two equal corners are dropped and counted.
// False on anything truncated, lying, non-finite or out of range: the message gives the line
// (ascii) or byte offset (binary), and nothing is allocated before the file has proved its size.
typedef bool PlyParse(Mesh *mesh, const char *bytes, size_t size, const char *name, Error *error);
PlyParse ply_parse;

// The same for whoever looks for faults: coordinates and normals that are not finite or out of
// range are counted in mesh, and so are the triangles dropped with them.
PlyParse ply_parse_tolerantly;
