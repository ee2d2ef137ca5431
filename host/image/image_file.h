// SPDX-License-Identifier: MIT
// Writes a Framebuffer to a file: PNG by libpng, PFM by our own writer, and other formats by
// OpenImageIO if clrt is built with it. A separate process loads OpenImageIO while the picture is
// traced. Loading takes 0.17 s and 132 MB, which few runs need.
#pragma once

#include "image/framebuffer.h"

typedef enum { ENCODE_RAW, ENCODE_SRGB } Encoding;

// A name and value stored in the file: by name in PNG and EXR, as lines of the description in TIFF
// and JPEG.
typedef struct {
    const char *name, *value;
} ImageText;

typedef struct {
    const char *format; // png, jpg, tif, ppm, exr, hdr or pfm
    Encoding encoding;  // of 8-bit formats; floats are written unchanged
    const ImageText *texts;
    size_t text_count;
    // The picture's position in a whole picture of that size, for formats that store it; 0: it is
    // whole.
    uint32_t left, top, whole_width, whole_height;
    const Layers *layers; // channels beside the colors, for formats that store them; NULL for none
} ImageSettings;

// Returns the format of a path's extension, NULL if it has none or clrt does not write it.
const char *image_format_of_path(const char *path);

// Returns the format called name (also jpeg, tiff), NULL if clrt does not write it.
const char *image_format_named(const char *name);

// Returns whether a format that clrt writes stores floats.
bool image_format_is_float(const char *format);
// Returns whether a format stores layers. Only EXR does.
bool image_format_takes_layers(const char *name);

// Returns all format names of this build, for messages.
const char *image_format_names(void);

// Returns half of the format's smallest step between values from 0 to 1. Smaller differences do
// not show in the file.
double image_format_half_step(const char *format, Encoding encoding);

// Starts loading the format's writer in another process and returns at once. Only main may call
// it, before other threads start.
void image_prepare(const char *format);

// Returns whether the format can store a picture of that size.
bool image_check_size(const char *format, uint32_t width, uint32_t height, Error *error);

// Writes the picture to path ("-": standard output), as base/output_file.h describes.
bool image_write(const Framebuffer *framebuffer, const char *path, const ImageSettings *settings,
                 Error *error);

// Rounds count values to the nearest of 256 steps. ENCODE_SRGB applies the sRGB curve (IEC
// 61966-2-1) first.
void encode_channels(const float *values, size_t count, Encoding encoding, unsigned char *bytes);

// Encodes a whole picture as width * height * 3 bytes. The caller frees them; NULL if memory runs
// out.
unsigned char *encode_bytes(const Framebuffer *framebuffer, Encoding encoding, Error *error);
