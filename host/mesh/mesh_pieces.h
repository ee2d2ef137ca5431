// SPDX-License-Identifier: MIT
// Mesh -> its pieces. A piece is a set of triangles that are connected by shared vertices. All sets
// with fewer than PIECE_TRIANGLES triangles are merged into one piece, because triangles share no
// vertices in some files.
#pragma once

#include "mesh/mesh.h"

#define PIECE_TRIANGLES 8

typedef struct {
    uint32_t *order; // triangles sorted by piece; NULL: a single piece, in file order
    uint32_t *ends;  // the end of each piece, as an index in `order`
    uint32_t count;
} MeshPieces;

bool mesh_pieces_make(MeshPieces *pieces, const Mesh *mesh, Error *error);
void mesh_pieces_free(MeshPieces *pieces);
