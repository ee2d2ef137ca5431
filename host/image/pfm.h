// SPDX-License-Identifier: MIT
// Framebuffer -> PFM, the portable float map: a text header and the floats themselves.
#pragma once

#include "image/framebuffer.h"

#include <stdio.h>

// Writes little-endian floats, the bottom row first, as the format has it.  False on a write error.
bool pfm_write(const Framebuffer *framebuffer, FILE *stream);
