// SPDX-License-Identifier: MIT
// Reads a PLY file, ASCII or binary of either byte order, into a Mesh. Format: Greg Turk, "The PLY
// Polygon File Format", Stanford 1994.
#pragma once

#include "base/error.h"
#include "mesh/mesh.h"

#include <stdbool.h>

typedef struct {
    const char *bytes;
    size_t size;
    const char *name; // of the file, for messages

    // Accepts positions and normals that are not finite or out of range, and counts them in the
    // mesh. Also counts the triangles dropped because of bad positions. `clrt check` needs this.
    bool is_tolerant;

    // The bytes are a part that clrt-foreign sends. Messages give no lines and no byte offsets,
    // because these are not positions in the model's file.
    bool is_part;
} PlySource;

// Fills *mesh from a PLY file.
//
// The parser reads the properties x y z nx ny nz red green blue of the element vertex. It also
// reads the list vertex_indices (or vertex_index) of the elements face and tristrips. It skips all
// other elements and properties, and colors of other types than uchar, ushort, float and double. It
// clamps colors to [0, 1]. It divides each polygon into triangles that share the polygon's first
// corner. Triangles with two equal corners are dropped and counted.
//
// Returns false if data are truncated, inconsistent, not finite or out of range. Also returns false
// if a file without triangles has elements that the parser skips. The message gives the line or, in
// a binary body, the byte offset. The parser allocates memory only if the file is long enough for
// the elements.
bool ply_parse(Mesh *mesh, const PlySource *source, Error *error);
