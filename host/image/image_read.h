// SPDX-License-Identifier: MIT
// Reads a picture file into a StoredImage. libpng reads PNG and our own reader PFM. OpenImageIO
// reads the other formats that clrt writes, in a process that may crash without harm. The first
// bytes determine the format, regardless of the file name.
#pragma once

#include "image/stored_image.h"

// Reads the file; on failure returns false with a message that names it. The caller frees the
// image. Only main may call it, before other threads start.
bool image_read(StoredImage *image, const char *path, Error *error);
