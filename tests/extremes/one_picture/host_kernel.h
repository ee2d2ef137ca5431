// SPDX-License-Identifier: MIT
// The kernels of the ray family, compiled for the host by clang without OpenCL.
#pragma once

#include "accel/flat.h"
#include "image/framebuffer.h"

// Draws the picture that frame describes, as one tile. flat has the layout of pairs.
void host_kernel_draw(const FrameData *frame, const FlatScene *flat, Framebuffer *picture);
