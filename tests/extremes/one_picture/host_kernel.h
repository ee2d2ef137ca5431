// SPDX-License-Identifier: MIT
// The kernels of the ray family as clang compiles them for the host, without OpenCL: the same
// source, another compiler and another library beneath it.
#pragma once

#include "accel/flat.h"
#include "image/framebuffer.h"

// Draws all of the picture that frame describes, of a scene laid out in pairs, as one tile.
void host_kernel_draw(const FrameData *frame, const FlatScene *flat, Framebuffer *picture);
