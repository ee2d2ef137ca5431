// SPDX-License-Identifier: MIT
// The pixels that thin parts touch, and the probes in these pixels (thin_parts.h). thin_parts.c,
// thin_places.c and thin_triangles.c share these data.
#pragma once

#include "base/array.h"
#include "refine/outline.h"
#include "refine/probe.h"
#include "refine/refine_setup.h"

#define THIN_SAMPLES 16

// The width of the thickest thin part, in places: a pixel's diagonal.
#define THIN_WIDTH (1.41421356 * REFINE_GRID)

// The lines of a pixel: rows or columns, whichever the thin parts cross. THIN_TOUCHED: thin parts
// touch the pixel, but request no lines.
typedef enum { THIN_NONE, THIN_TOUCHED, THIN_ROWS, THIN_COLUMNS } ThinAxis;

typedef ARRAY(Probe) ProbeList;

typedef struct {
    CellGrid pixels;                // of the picture
    _Atomic uint8_t *axes;          // ThinAxis by pixel
    _Atomic uint64_t touched;       // number of pixels that thin parts touch
    ProbeList probes;               // sorted by pixel
    size_t counted;                 // probes in `counts`
    uint64_t counts[REFINE_LEVELS]; // by level: number of probes of the level that are on a line of
                                    // this level
} ThinParts;

// Records that a thin part touches a pixel. The pixel keeps its axis if it has one already. Threads
// may call this function at the same time with the same axis.
void thin_parts_touch(ThinParts *parts, uint32_t pixel, ThinAxis axis);

// Returns the number of levels whose probes take at most THIN_SAMPLES samples per pixel of the
// picture.
uint32_t thin_parts_affordable(ThinParts *parts);

// Returns the index of the first probe of this pixel or of a later one, or the number of probes.
size_t thin_parts_first_probe(const ThinParts *parts, uint32_t pixel);

// Compares elements of an array by their first member, which is a pixel, as qsort needs it.
int thin_compare_pixels(const void *one, const void *other);

// The places `first` to `end` - 1 of a line, which a thin part covers. They may be outside of the
// pixel.
typedef struct {
    uint32_t pixel, line, level;
    int first, end;
} ProbeRun;

// Adds probes at the first and last place of the run, and at the two places next to the run.
bool probe_list_add(ProbeList *probes, const ProbeRun *run, Error *error);

// Places are PLACE_PROBED if their run has probes, or if it is near a run of the previous level
// that is PLACE_PROBED.
typedef enum { PLACE_EMPTY, PLACE_DRAWN, PLACE_PROBED } PlaceState;

// The states of a pixel's places, line by line.
typedef uint8_t ThinDrawing[REFINE_GRID][REFINE_GRID];

// Adds probes so that samples hit the parts of the drawing. Uses bands of the first `levels`
// levels.
bool thin_drawing_probe(ThinDrawing drawing, uint32_t pixel, uint32_t levels, ProbeList *probes,
                        Error *error);

// Finds the thin triangles in the frame. Without `has_probes`, finds only the pixels that they
// touch.
bool thin_triangles_find(ThinParts *parts, const RefineSetup *setup, const FrameData *frame,
                         bool has_probes, Error *error);
