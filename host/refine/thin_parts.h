// SPDX-License-Identifier: MIT
// Finds the cells to subdivide so that samples hit triangles and spheres that are thinner than a
// pixel. Samples may miss such parts completely, so contrast alone would not find them.
//
// A triangle is thin at a level if no disk whose diameter is the cells' diagonal fits into it.
// Every cell of that level that a thin triangle touches is subdivided, unless the triangle's mesh
// piece is wide at the cell. A piece is wide at a cell if it contains all four samples around some
// corner of the cell or of an adjacent cell. Such a piece is at least as wide as a cell, and
// contrast finds its outline. At levels above 0, the search of a pixel considers only thin
// triangles that touch the pixel or a margin around it.
//
// Invariant: a sample hits each sphere that is at least 1/57 pixel across, and each triangle whose
// incircle is at least 1/57 pixel across. The exceptions are
// - triangles within two pixels of a wider part of the same piece (two cells at deeper levels);
// - hidden triangles and spheres, on which samples are wasted;
// - parts that are visible only in mirrors or by their shadows;
// - the thinnest parts, if all subdivisions together would take more than THIN_SAMPLES samples per
//   pixel of the picture. The deepest levels are then omitted;
// - pieces with too many thin triangles to list (thin_triangles.c). Only level 0 is then searched.
#pragma once

#include "refine/thin_cells.h"

bool thin_parts_make(ThinParts *parts, const ThinSource *source, Error *error);
void thin_parts_free(ThinParts *parts);
