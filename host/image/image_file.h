// SPDX-License-Identifier: MIT
// Writes a Framebuffer to a file, and reads a StoredImage from a file. libpng writes PNG, pfm.c
// writes PFM, and OpenEXRCore writes EXR. OpenImageIO writes the other formats, if clrt is built
// with it. Loading OpenImageIO takes 0.1 s, so clrt loads it only for the other formats.
#pragma once

#include "image/image_settings.h"
#include "image/stored_image.h"

// Returns the format that the path's extension names, or NULL if this build writes no such format.
const char *image_format_of_path(const char *path);

// Returns the format called `name`, or NULL if this build writes no such format. Ignores case.
const char *image_format_named(const char *name);

// Returns whether the format stores floats. The format must be one that this build writes.
bool image_format_is_float(const char *format);

// Returns whether a format stores layers. Only EXR does.
bool image_format_takes_layers(const char *name);

// Returns the names of this build's formats except GIF, for messages.
const char *image_format_names(void);

// Returns half of the smallest step between 8-bit values, in linear color. For formats of floats,
// returns half of the step between the largest floats below 1.
double image_format_half_step(const char *format, Encoding encoding);

// Returns whether the format can store a picture of this size.
bool image_check_size(const char *format, uint32_t width, uint32_t height, Error *error);

// Writes the picture to `path`, or to standard output if `path` is "-" (base/output_file.h).
bool image_write(const Framebuffer *framebuffer, const char *path, const ImageSettings *settings,
                 Error *error);

// Reads a picture file. The file's first bytes, not its name, determine the format. libpng reads
// PNG, and pfm.c reads PFM. In builds with OpenImageIO, clrt-foreign reads the other formats that
// clrt writes, except GIF. If clrt-foreign crashes, only the read fails. On failure, returns false
// with a message that names the file. The caller frees the image.
bool image_read(StoredImage *image, const char *path, Error *error);
