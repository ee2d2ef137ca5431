// SPDX-License-Identifier: MIT
// Writes a framebuffer and the picture's other channels as a tiled EXR file.
#pragma once

#include "image/exr_file.h"
#include "image/image_settings.h"

// Writes the header of a whole picture of this size, even if the file will contain only the tiles
// of a part. The caller then writes the table of tile positions, and the tiles. Returns false if
// writing fails. The caller ends the context with exr_finish in both cases.
bool exr_write_begin(exr_context_t *context, const ImageSettings *settings, uint32_t width,
                     uint32_t height, FILE *stream);

// Writes EXR in tiles: a whole picture, or the tiles of settings->part. The stream must be empty.
// Returns false on failure. The reason is in *cause or, if *cause is empty, in errno.
bool exr_write(const Framebuffer *framebuffer, const ImageSettings *settings, FILE *stream,
               Error *cause);
