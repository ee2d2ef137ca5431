// SPDX-License-Identifier: MIT
// The settings for writing a picture file.
#pragma once

#include "image/framebuffer.h"

// A text in the file. PNG and EXR files store it under `name`, but EXR files have another name for
// the date and omit the hash of the pixels. TIFF and JPEG files store clrt:NAME texts as lines of a
// description.
typedef struct {
    const char *name, *value;
} ImageText;

// A part of a picture. The framebuffer contains the part's tiles, one below the other.
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
    // A crop's position in the whole picture, and the size of the whole picture. Only EXR files
    // store them. All are 0 without a crop.
    uint32_t left, top, whole_width, whole_height;
    const ImagePart *part; // EXR only; NULL for a whole picture
    const Layers *layers;  // channels other than colors, for formats that store them; may be NULL
} ImageSettings;
