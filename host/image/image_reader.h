// SPDX-License-Identifier: MIT
// Runs OpenImageIO's readers in a process that lives for one file. A hostile file can only harm
// that process, whose memory, time and writing are limited. None of its output is trusted.
#pragma once

#include "image/stored_image.h"

// Reads the file in the given OpenImageIO format. On failure returns false and the reason alone.
// The caller frees the image in both cases.
bool image_reader_run(StoredImage *image, const char *path, const char *format, Error *cause);
