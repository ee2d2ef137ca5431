// SPDX-License-Identifier: MIT
// Picture file -> StoredImage: PNG by libpng, PFM by a reader of our own, and the other formats
// that clrt writes by OpenImageIO, in a process that is lost at worst.  The format is told by the
// first bytes, whatever the file is called.
#pragma once

#include "image/stored_image.h"

// Reads the file; false with one sentence that names it.  The caller frees the image.  For main
// alone, while no other thread runs.
bool image_read(StoredImage *image, const char *path, Error *error);
