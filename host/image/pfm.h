// SPDX-License-Identifier: MIT
// Portable float maps: a text header followed by raw floats.
#pragma once

#include "image/framebuffer.h"
#include "image/stored_image.h"

#include <stdio.h>

// Writes PFM with the bottom row first, as the format requires. The host must be little-endian.
// Returns false on a write error.
bool pfm_write(const Framebuffer *framebuffer, FILE *stream);

// Reads PFM with three channels or one, in either byte order. Ignores the magnitude of the header's
// scale. Rejects pictures of more than `most` values. On failure, returns false and stores the
// reason without the file name in *cause. The caller frees the image in both cases.
bool pfm_read(StoredImage *image, FILE *stream, uint64_t most, Error *cause);
