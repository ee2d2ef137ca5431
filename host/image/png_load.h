// SPDX-License-Identifier: MIT
// PNG -> StoredImage, of 8 or 16 bits a channel.
#pragma once

#include "image/stored_image.h"

#include <stdio.h>

// Reads the colors of any PNG, without its transparency; false with the reason alone.  The image is
// to be freed in either case.
bool png_load(StoredImage *image, FILE *stream, Error *cause);
