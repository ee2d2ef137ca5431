// SPDX-License-Identifier: MIT
// Finds places at which samples hit triangles and spheres that are thinner than a pixel. Other
// samples may miss such parts completely, so contrast alone would not find the parts.
//
// A triangle is thin if no disk whose diameter is a pixel's diagonal fits into it. Every pixel that
// a thin triangle touches is refined, unless the triangle's mesh piece is wide at the pixel. A
// piece is wide at a pixel if it contains the centers of all four pixels around some corner of the
// pixel or of an adjacent pixel. Such a piece is at least as wide as a pixel, and contrast finds
// its outline.
//
// In pixels at which a piece is not wide, its thin triangles are drawn on the grid of places
// (probe.h). On each line of level 0, each run of drawn places gets probes (requests for samples)
// on both sides of both ends. The lines of each further level lie closer together. A run gets
// probes only if the nearest lines of the level before have none nearby.
//
// Invariant: a sample hits each sphere that is at least 1/57 pixel across, and each triangle whose
// incircle is at least 1/57 pixel across. The exceptions are
// - triangles within two pixels of a wider part of the same piece;
// - triangles whose distance from a probe of the same piece is below a third of a pixel on both
//   axes;
// - hidden triangles and spheres, on which samples are wasted;
// - parts that are visible only in mirrors or by their shadows;
// - the thinnest parts, if all probes together would take more than THIN_SAMPLES samples per pixel
//   of the picture. The deepest levels are then omitted;
// - pieces with too many thin triangles to list (thin_triangles.c). Such pieces have no probes.
#pragma once

#include "refine/thin_places.h"

// Finds the thin parts in the frame. Without `has_probes`, finds only the pixels that they touch.
bool thin_parts_make(ThinParts *parts, const RefineSetup *setup, const FrameData *frame,
                     bool has_probes, Error *error);
void thin_parts_free(ThinParts *parts);
