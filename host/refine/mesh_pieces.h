// SPDX-License-Identifier: MIT
// Divides a mesh into pieces: sets of triangles connected by shared vertices. Pieces of fewer than
// PIECE_TRIANGLES triangles together form one piece, because some files share no vertices.
#pragma once

#include "base/error.h"
#include "base/parallel.h"
#include "mesh/mesh.h"

#define PIECE_TRIANGLES 8

typedef struct {
    uint32_t *order; // triangles sorted by piece; NULL: a single piece, in file order
    uint32_t *ends;  // the end of each piece in order
    uint32_t count;
} MeshPieces;

bool mesh_pieces_make(MeshPieces *pieces, const Mesh *mesh, Crew *crew, Error *error);
void mesh_pieces_free(MeshPieces *pieces);
