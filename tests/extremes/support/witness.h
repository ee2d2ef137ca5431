// SPDX-License-Identifier: MIT
// What a camera ray meets, found on the host in fp64 by testing every primitive of the device's own
// arrays, and whether that is clear: rounding may decide what happens at an outline.
#pragma once

#include "accel/flat.h"

typedef struct {
    uint32_t material; // NOTHING where it meets nothing
    bool clear;        // no outline passes within the margin
} Witness;

// The ray through the middle of pixel (x, y) of a picture with one sample a pixel.
Witness witness_pixel(const FlatScene *flat, const CameraData *camera, uint32_t size, uint32_t x,
                      uint32_t y);
