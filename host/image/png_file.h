// SPDX-License-Identifier: MIT
// Framebuffer -> PNG of 8 bits a channel, with texts.
#pragma once

#include "image/image_file.h"

#include <stdio.h>

// Writes the picture in the encoding of settings, and its texts.  False on a fault, with the reason
// in error or, where the last bytes could not be written, in errno.
bool png_file_write(const Framebuffer *framebuffer, const ImageSettings *settings, FILE *stream,
                    Error *error);
