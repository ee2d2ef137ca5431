// SPDX-License-Identifier: MIT
// Framebuffer -> PFM -> StoredImage.  The portable float map: a text header and the floats
// themselves.
#pragma once

#include "image/framebuffer.h"
#include "image/stored_image.h"

#include <stdio.h>

// Writes little-endian floats, the bottom row first, as the format has it.  False on a write error.
bool pfm_write(const Framebuffer *framebuffer, FILE *stream);

// Reads one of three channels or of one, in either order of bytes; false with the reason alone.
// The scale is not applied.  The image is to be freed in either case.
bool pfm_read(StoredImage *image, FILE *stream, Error *cause);
