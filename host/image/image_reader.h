// SPDX-License-Identifier: MIT
// OpenImageIO's readers, in a process that lives for one file.  What a hostile file does to them
// stays there: the process has limits on its memory, its time and what it writes, and is believed
// nothing.
#pragma once

#include "image/stored_image.h"

// Reads the file, which is of OpenImageIO's format; false with the reason alone.  The image is to
// be freed in either case.
bool image_reader_run(StoredImage *image, const char *path, const char *format, Error *cause);
