// SPDX-License-Identifier: MIT
// Finds the cells to subdivide so that samples hit triangles and spheres thinner than a pixel,
// regardless of contrast.
//
// A triangle is thin at a level if no disk with the cells' diagonal as diameter fits into it. Every
// cell of that level that a thin triangle touches is subdivided, unless the triangle's mesh piece
// is wide at the cell. A piece is wide at a cell if it contains all four samples around some corner
// of the cell or of an adjacent cell. Such a piece is at least as wide as a cell, and contrast
// finds its outline. At levels above 0, the search considers only thin triangles that touch the
// pixel or its margin.
//
// A sample therefore hits each sphere at least 1/57 pixel across and each triangle whose incircle
// is at least 1/57 pixel across, except
// - triangles within two pixels of a wider part of the same piece, and at deeper levels within two
//   cells of it;
// - hidden triangles and spheres, on which samples are wasted;
// - parts visible only in mirrors or by their shadows;
// - the thinnest parts, if all subdivisions together would take more than THIN_SAMPLES samples per
//   pixel of the picture. The deepest levels are then omitted;
// - pieces with too many thin triangles to list (thin_triangles.c). Only level 0 is then searched.
#pragma once

#include "base/thread_pool.h"
#include "refine/refine_tree.h"
#include "scene/normalize.h"

#define THIN_SAMPLES 16

typedef struct {
    uint32_t width, height;
    uint32_t *slots;                     // of pixels, row by row; 0: no thin part
    uint32_t count;                      // of slots; slots are numbered from 1
    ARRAY(uint32_t) rows[REFINE_LEVELS]; // by level, then slot: a mask of cells for each row
    uint64_t cuts[REFINE_LEVELS];        // cells to subdivide, by level
    uint32_t most;                       // levels to search
    uint32_t levels;                     // number of levels with subdivisions
} ThinParts;

// The input of the search.
typedef struct {
    const FrameData *frame; // its camera is made for REFINE_GRID samples
    const Scene *scene;
    const Normalization *normalization; // of the scene
    const SphereData *spheres;          // of the frame
    ThreadPool *pool;                   // threads for the work, NULL for none
    uint32_t levels;                    // to search, from 1 to REFINE_LEVELS
} ThinSource;

bool thin_parts_make(ThinParts *parts, const ThinSource *source, Error *error);
void thin_parts_free(ThinParts *parts);

// Returns whether a thin part touches the pixel.
static inline bool thin_parts_touch(const ThinParts *parts, uint32_t pixel)
{
    return parts->slots[pixel] != 0;
}

// Returns the number of a level's cells along a pixel's side.
static inline uint32_t thin_parts_scale(uint32_t level)
{
    return REFINE_GRID / refine_tree_cell_side(level);
}

// Returns whether the cell of a level at that place must be subdivided. The unit of place is a cell
// of the last level.
static inline bool thin_parts_cut(const ThinParts *parts, const uint32_t place[2], uint32_t level)
{
    const uint32_t side = refine_tree_cell_side(level), scale = thin_parts_scale(level);
    if (level >= parts->levels)
        return false;
    const uint32_t slot =
        parts->slots[(size_t)(place[1] / REFINE_GRID) * parts->width + place[0] / REFINE_GRID];
    return slot != 0 && (parts->rows[level].data[(size_t)slot * scale + place[1] / side % scale] >>
                             (place[0] / side % scale) &
                         1) != 0;
}

// Divides a mesh into pieces: sets of triangles connected by shared vertices. All sets of fewer
// than PIECE_TRIANGLES triangles are merged into one piece, because triangles of some files share
// no vertices.

#define PIECE_TRIANGLES 8

typedef struct {
    uint32_t *order; // triangles sorted by piece; NULL: a single piece, in file order
    uint32_t *ends;  // the end of each piece, as an index into order
    uint32_t count;
} MeshPieces;

bool mesh_pieces_make(MeshPieces *pieces, const Mesh *mesh, Error *error);
void mesh_pieces_free(MeshPieces *pieces);
