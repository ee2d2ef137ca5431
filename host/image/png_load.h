// SPDX-License-Identifier: MIT
// Reads PNG of 8 or 16 bits a channel into a StoredImage.
#pragma once

#include "image/stored_image.h"

#include <stdio.h>

// Reads the colors of any PNG, without transparency. On failure returns false and the reason
// alone. The caller frees the image in both cases.
bool png_load(StoredImage *image, FILE *stream, Error *cause);
