// SPDX-License-Identifier: MIT
// The formats that clrt reads or writes without OpenImageIO: PNG, EXR and PFM. A portable float map
// (PFM) is a text header followed by raw floats.
#pragma once

#include "image/image_file.h"
#include "image/stored_image.h"

#include <stdio.h>

// Writes PNG with 8 bits per channel and the encoding and texts of settings. Returns false on
// failure. The reason is in error, or in errno if the last bytes could not be written.
bool png_file_write(const Framebuffer *framebuffer, const ImageSettings *settings, FILE *stream,
                    Error *error);

// The readers reject pictures of more than `most` values.

// Reads the colors of any PNG with up to 16 bits per channel, and ignores transparency. On failure
// returns false and the reason without the file name. The caller frees the image in both cases.
bool png_file_read(StoredImage *image, FILE *stream, uint64_t most, Error *cause);

// Writes PFM with the bottom row first, as the format requires. The host must be little-endian.
// Returns false on a write error.
bool pfm_write(const Framebuffer *framebuffer, FILE *stream);

// Reads PFM with three channels or one, in either byte order. Does not apply the file's scale. On
// failure returns false and the reason without the file name. The caller frees the image in both
// cases.
bool pfm_read(StoredImage *image, FILE *stream, uint64_t most, Error *cause);

// Writes EXR in tiles: a whole picture, or the tiles of settings->part. The stream must be empty.
// Returns false on failure. The reason is in cause or in errno.
bool exr_write(const Framebuffer *framebuffer, const ImageSettings *settings, FILE *stream,
               Error *cause);
