// SPDX-License-Identifier: MIT
// Writes a Framebuffer as PNG of 8 bits a channel, with texts.
#pragma once

#include "image/image_file.h"

#include <stdio.h>

// Writes the picture in the encoding of settings, with its texts. Returns false on a fault. The
// reason is in error, or in errno if the last bytes could not be written.
bool png_file_write(const Framebuffer *framebuffer, const ImageSettings *settings, FILE *stream,
                    Error *error);
