// SPDX-License-Identifier: MIT
// The samples at the centers of a picture's pixels.
#pragma once

#include "render/sampler.h"

typedef struct {
    uint32_t width, height;
    SampleData *samples; // in blocks of PACKET_SIDE x PACKET_SIDE, row by row
} Centers;

// Traces the centers of all pixels. The frame must be made for REFINE_GRID samples. If the observer
// stops the trace, the missing samples are zeros.
bool centers_trace(Centers *centers, Renderer *renderer, const FrameData *frame,
                   const RenderObserver *observer, Error *error);
void centers_free(Centers *centers);

// Returns the sample of a pixel. Pixels are numbered row by row.
const SampleData *centers_at(const Centers *centers, uint32_t pixel);

typedef enum { SIDE_LEFT, SIDE_RIGHT, SIDE_ABOVE, SIDE_BELOW } Side;

// Returns whether the pixel has a neighbor on that side, and stores the neighbor.
bool centers_have_neighbor(const Centers *centers, uint32_t pixel, Side side, uint32_t *neighbor);

// Returns the sample of the neighbor, or of the pixel itself at the picture's border.
const SampleData *centers_beside(const Centers *centers, uint32_t pixel, Side side);
