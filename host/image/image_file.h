// SPDX-License-Identifier: MIT
// Writes a Framebuffer to a file. libpng writes PNG, pfm.c writes PFM, and OpenImageIO writes other
// formats if clrt is built with it. Loading OpenImageIO takes 0.17 s and 132 MB. Only runs that
// need OpenImageIO load it, in a separate process while they trace.
#pragma once

#include "image/framebuffer.h"
#include "image/layers.h"

typedef enum { ENCODE_RAW, ENCODE_SRGB } Encoding;

// A text stored in the file. PNG and EXR store it under its name. TIFF and JPEG store it as a line
// of the description.
typedef struct {
    const char *name, *value;
} ImageText;

typedef struct {
    const char *format; // png, jpg, tif, ppm, exr, hdr or pfm
    Encoding encoding;  // for 8-bit formats; float formats store values unchanged
    const ImageText *texts;
    size_t text_count;
    // A crop's position in the whole picture and the whole picture's size, for formats that store
    // them. whole_width is 0 without a crop.
    uint32_t left, top, whole_width, whole_height;
    const Layers *layers; // channels other than colors, for formats that store them; may be NULL
} ImageSettings;

// Returns the format that the path's extension names. Returns NULL if there is no extension or this
// build does not write the format.
const char *image_format_of_path(const char *path);

// Returns the format called name, in any case, including "jpeg" and "tiff". Returns NULL if this
// build does not write the format.
const char *image_format_named(const char *name);

// Returns whether the format stores floats. format must be one that this build writes.
bool image_format_is_float(const char *format);
// Returns whether a format stores layers. Only EXR does.
bool image_format_takes_layers(const char *name);

// Returns the names of all formats that this build writes, for messages.
const char *image_format_names(void);

// Returns half of the smallest step between adjacent 8-bit values, in linear color. For float
// formats, returns half of the distance between floats just below 1.
double image_format_half_step(const char *format, Encoding encoding);

// Starts a process that loads the format's writer, and returns at once. Only main may call this
// function, before other threads start.
void image_prepare(const char *format);

// Returns whether the format can store a picture of this size.
bool image_check_size(const char *format, uint32_t width, uint32_t height, Error *error);

// Writes the picture to path, or to standard output if path is "-". base/output_file.h describes
// how clrt replaces the file.
bool image_write(const Framebuffer *framebuffer, const char *path, const ImageSettings *settings,
                 Error *error);
