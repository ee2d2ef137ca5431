// SPDX-License-Identifier: MIT
// Thin parts, drawn on a pixel's grid of places -> probes (thin_parts.h).
#pragma once

#include "refine/thin_places.h"

// Places are PLACE_PROBED if they are on a run with probes, or connected with such a run nearby.
typedef enum { PLACE_EMPTY, PLACE_DRAWN, PLACE_PROBED } PlaceState;

// The states of a pixel's places, line by line.
typedef uint8_t ThinDrawing[REFINE_GRID][REFINE_GRID];

// Adds probes so that samples hit each connected part of the drawing. Uses bands of the first
// `levels` levels.
bool thin_drawing_probe(ThinDrawing drawing, uint32_t pixel, uint32_t levels, ProbeList *probes,
                        Error *error);
