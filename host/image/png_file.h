// SPDX-License-Identifier: MIT
// PNG files, written and read by libpng.
#pragma once

#include "image/image_settings.h"
#include "image/stored_image.h"

#include <stdio.h>

// Writes PNG with 8 bits per channel and the encoding, exposure and texts of `settings`. Returns
// false on failure. The reason is in *error or, if *error is empty, in errno.
bool png_file_write(const Framebuffer *framebuffer, const ImageSettings *settings, FILE *stream,
                    Error *error);

// Reads the colors of any PNG, and ignores transparency. Rejects pictures of more than `most`
// values. On failure, returns false and stores the reason without the file name in *cause. The
// caller frees the image in both cases.
bool png_file_read(StoredImage *image, FILE *stream, uint64_t most, Error *cause);
