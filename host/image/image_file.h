// SPDX-License-Identifier: MIT
// Writes a Framebuffer to a file. libpng writes PNG, pfm.c writes PFM, and OpenEXRCore writes EXR.
// OpenImageIO writes the other formats, if clrt is built with it. Only these other formats load
// OpenImageIO, which takes 0.1 s.
#pragma once

#include "image/framebuffer.h"

typedef enum { ENCODE_RAW, ENCODE_SRGB } Encoding;

// A text in the file. PNG stores it under its name. EXR does too, but it names the date differently
// and omits the hash of the pixels. TIFF and JPEG store clrt:NAME texts as lines of a description.
typedef struct {
    const char *name, *value;
} ImageText;

// A part of a picture: the tiles that the framebuffer contains, below each other.
typedef struct {
    uint32_t width, height;           // of the picture or crop that is divided into parts
    uint32_t tile_width, tile_height; // of unclipped tiles
    uint32_t (*tiles)[2];             // X and Y of each tile in this picture or crop; owned
    size_t tile_count;
} ImagePart;

typedef struct {
    const char *format; // png, jpg, jpeg, tif, tiff, ppm, exr, hdr, gif or pfm
    Encoding encoding;  // for 8-bit formats; float formats store values unchanged
    double exposure;    // for 8-bit formats, in stops
    uint32_t frames;    // of a GIF, below each other in the framebuffer; 0 counts as 1
    const ImageText *texts;
    size_t text_count;
    // A crop's position in the whole picture and the whole picture's size, for formats that store
    // them; 0 without a crop.
    uint32_t left, top, whole_width, whole_height;
    const ImagePart *part; // EXR only; NULL for a whole picture
    const Layers *layers;  // channels other than colors, for formats that store them; may be NULL
} ImageSettings;

// Returns the format that the path's extension names, or NULL if this build writes no such format.
const char *image_format_of_path(const char *path);

// Returns the format called name (also jpeg, tiff), or NULL if this build writes no such format.
const char *image_format_named(const char *name);

// Returns whether the format stores floats. format must be one that this build writes.
bool image_format_is_float(const char *format);
// Returns whether a format stores layers. Only EXR does.
bool image_format_takes_layers(const char *name);

// Returns the names of this build's formats except GIF, for messages.
const char *image_format_names(void);

// Returns half of the smallest step between 8-bit values, in linear color. For formats of floats,
// returns half of the step below 1.
double image_format_half_step(const char *format, Encoding encoding);

// Returns whether the format can store a picture of this size.
bool image_check_size(const char *format, uint32_t width, uint32_t height, Error *error);

// Writes the picture to path, or to standard output if path is "-" (base/output_file.h).
bool image_write(const Framebuffer *framebuffer, const char *path, const ImageSettings *settings,
                 Error *error);

// Multiplies count values by gain, limits them to 1 and rounds them to the nearest of 256 steps.
// ENCODE_SRGB applies the sRGB curve (IEC 61966-2-1) before rounding.
void encode_channels(const float *values, size_t count, Encoding encoding, double gain,
                     unsigned char *bytes);

// Encodes a whole picture as width * height * 3 bytes. The caller frees them; NULL if memory runs
// out.
unsigned char *encode_bytes(const Framebuffer *framebuffer, const ImageSettings *settings,
                            Error *error);
