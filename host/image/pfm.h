// SPDX-License-Identifier: MIT
// Writes a Framebuffer as PFM and reads PFM into a StoredImage. PFM, the portable float map, is a
// text header followed by raw floats.
#pragma once

#include "image/framebuffer.h"
#include "image/stored_image.h"

#include <stdio.h>

// Writes little-endian floats, bottom row first, as the format requires. Returns false on a write
// error.
bool pfm_write(const Framebuffer *framebuffer, FILE *stream);

// Reads a file of three channels or one, in either byte order. On failure returns false and the
// reason alone. The scale is not applied. The caller frees the image in both cases.
bool pfm_read(StoredImage *image, FILE *stream, Error *cause);
