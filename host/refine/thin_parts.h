// SPDX-License-Identifier: MIT
// Finds the cells to subdivide so that samples hit triangles thinner than a pixel, regardless of
// contrast.
//
// A triangle is thin at a level if no disk with the cells' diagonal as diameter fits into it. Every
// cell of that level that a thin triangle touches is subdivided, unless the triangle's mesh piece
// is wide at the cell. A piece is wide at a cell if it contains all four samples around some corner
// of the cell or of an adjacent cell. Such a piece is at least as wide as a cell, and contrast
// finds its outline.
//
// A sample therefore hits each triangle whose incircle is at least 1/57 pixel across, except
// - triangles within two pixels of a wider part of the same piece, and at deeper levels within two
//   cells of it;
// - hidden triangles, on which samples are wasted;
// - triangles visible only in mirrors or by their shadows;
// - the thinnest triangles, if all subdivisions together would take more than THIN_SAMPLES samples
//   per pixel of the picture. The deepest levels are then omitted.
#pragma once

#include "base/error.h"
#include "base/thread_pool.h"
#include "mesh/mesh.h"
#include "refine/cell_set.h"
#include "refine/refine_tree.h"
#include "scene/normalize.h"

#define THIN_SAMPLES 16

// Must not be moved or copied, because the sets in cut point to slots.
typedef struct {
    Slots slots;
    CellSet cut[REFINE_LEVELS]; // cells to subdivide, by level
    uint32_t levels;            // levels with subdivisions
} ThinParts;

// The input of the search.
typedef struct {
    const FrameData *frame; // its camera is made for REFINE_GRID samples
    const Scene *scene;
    const Normalization *normalization; // of the scene
    ThreadPool *pool;                   // to share the work, NULL for none
} ThinSource;

bool thin_parts_make(ThinParts *parts, const ThinSource *source, Error *error);
void thin_parts_free(ThinParts *parts);

// Returns whether the cell of a level at that place must be subdivided. The unit of place is a cell
// of the last level.
static inline bool thin_parts_cut(const ThinParts *parts, const uint32_t place[2], uint32_t level)
{
    const uint32_t side = refine_tree_cell_side(level);
    return level < parts->levels &&
           cell_set_has(&parts->cut[level], place[0] / side, place[1] / side);
}

// Returns a mask of 32 pixels of a row from column left on, a multiple of 32. Set bits mark pixels
// to subdivide.
static inline uint32_t thin_parts_pixels(const ThinParts *parts, uint32_t left, uint32_t row)
{
    return parts->levels == 0 ? 0 : pixel_set_bits(&parts->cut[0], left, row);
}

// Returns a bit for each cell of a group that must be subdivided.
unsigned thin_parts_marks(const ThinParts *parts, const CellGroup *group);

// Finds the cells to subdivide so that a sample hits each sphere smaller than a pixel, regardless
// of contrast.

// The projection of a small sphere in one pixel, in cells of the last level.
typedef struct {
    uint32_t pixel;     // row by row
    float x, y;         // of the center
    float inner, outer; // radii of disks inside and around its outline
} Footprint;

typedef struct {
    ARRAY(Footprint) list; // in the order of the pixels
    uint32_t width;        // of the picture
} Footprints;

// Projects the spheres that fit between the samples of neighboring pixels. The frame's camera must
// be made for REFINE_GRID samples.
bool footprints_make(Footprints *footprints, const FrameData *frame, const SphereData *spheres,
                     Error *error);
void footprints_free(Footprints *footprints);

// Returns a bit for each cell of a group that must be subdivided to hit a sphere.
unsigned footprints_marks(const Footprints *footprints, const CellGroup *group);

// Divides a mesh into pieces: sets of triangles connected by shared vertices. Pieces of fewer than
// PIECE_TRIANGLES triangles together form one piece, because some files share no vertices.

#define PIECE_TRIANGLES 8

typedef struct {
    uint32_t *order; // triangles sorted by piece; NULL: a single piece, in file order
    uint32_t *ends;  // the end of each piece in order
    uint32_t count;
} MeshPieces;

bool mesh_pieces_make(MeshPieces *pieces, const Mesh *mesh, ThreadPool *pool, Error *error);
void mesh_pieces_free(MeshPieces *pieces);
