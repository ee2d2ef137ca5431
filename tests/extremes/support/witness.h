// SPDX-License-Identifier: MIT
// Finds a camera ray's hit on the host, in fp64, by testing every primitive of the device's own
// arrays. Also returns whether the hit is clear, because rounding may decide at an outline.
#pragma once

#include "accel/flat.h"

typedef struct {
    uint32_t material; // NOTHING where it meets nothing
    bool clear;        // no outline passes within the margin
} Witness;

// The ray through the middle of pixel (x, y) of a picture with one sample a pixel.
Witness witness_pixel(const FlatScene *flat, const CameraData *camera, uint32_t size, uint32_t x,
                      uint32_t y);
