// SPDX-License-Identifier: MIT
// Reads a picture file into a StoredImage.
#pragma once

#include "image/stored_image.h"

// The file's first bytes, not its name, determine the format. libpng reads PNG, and pfm.c reads
// PFM. In builds with OpenImageIO, clrt-foreign reads the other formats that clrt writes, except
// GIF. If clrt-foreign crashes, only the read fails. On failure, returns false with a message that
// names the file. The caller frees the image.
bool image_read(StoredImage *image, const char *path, Error *error);
