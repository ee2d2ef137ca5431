// SPDX-License-Identifier: MIT
// The formats that clrt reads or writes without OpenImageIO: PNG, PFM, the portable float map,
// which is a text header followed by raw floats, and EXR.
#pragma once

#include "image/image_file.h"
#include "image/stored_image.h"

#include <stdio.h>

// Writes PNG of 8 bits a channel, in the encoding of settings and with its texts. Returns false on
// a fault. The reason is in error, or in errno if the last bytes could not be written.
bool png_file_write(const Framebuffer *framebuffer, const ImageSettings *settings, FILE *stream,
                    Error *error);

// Reads the colors of any PNG, of 8 or 16 bits a channel, without transparency. On failure returns
// false and the reason alone. The caller frees the image in both cases.
bool png_file_read(StoredImage *image, FILE *stream, Error *cause);

// Writes PFM: little-endian floats, bottom row first, as the format requires. Returns false on a
// write error.
bool pfm_write(const Framebuffer *framebuffer, FILE *stream);

// Reads PFM of three channels or one, in either byte order. On failure returns false and the
// reason alone. The scale is not applied. The caller frees the image in both cases.
bool pfm_read(StoredImage *image, FILE *stream, Error *cause);

// Writes EXR in tiles: a whole picture, or the tiles of settings->part. The stream must be empty.
// Returns false on a fault. The reason is in cause, or in errno.
bool exr_write(const Framebuffer *framebuffer, const ImageSettings *settings, FILE *stream,
               Error *cause);
