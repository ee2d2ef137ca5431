// SPDX-License-Identifier: MIT
// Divides a mesh into pieces: sets of triangles connected by shared vertices. All pieces with few
// triangles together count as one, for files without shared vertices.
#pragma once

#include "base/error.h"
#include "base/parallel.h"
#include "mesh/mesh.h"

// Pieces with fewer triangles are united.
#define PIECE_TRIANGLES 8

typedef struct {
    uint32_t *order; // triangles sorted by piece; NULL if there is one piece, in file order
    uint32_t *ends;  // the end of each piece in that order
    uint32_t count;
} MeshPieces;

bool mesh_pieces_make(MeshPieces *pieces, const Mesh *mesh, Crew *crew, Error *error);
void mesh_pieces_free(MeshPieces *pieces);
