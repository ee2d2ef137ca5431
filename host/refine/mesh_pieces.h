// SPDX-License-Identifier: MIT
// Mesh -> its pieces: triangles that are joined by the vertices they share.  Those of a few
// triangles, as in files that share no vertices, count as one.
#pragma once

#include "base/error.h"
#include "base/thread_pool.h"
#include "mesh/mesh.h"

// Pieces of fewer triangles are one.
#define PIECE_TRIANGLES 8

typedef struct {
    uint32_t *order; // the triangles piece by piece; NULL for file order, where there is one piece
    uint32_t *ends;  // of each piece, in that order
    uint32_t count;
} MeshPieces;

bool mesh_pieces_make(MeshPieces *pieces, const Mesh *mesh, ThreadPool *pool, Error *error);
void mesh_pieces_free(MeshPieces *pieces);
