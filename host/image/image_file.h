// SPDX-License-Identifier: MIT
// Framebuffer -> picture file: PNG by libpng, PFM by a writer of our own, and the other formats by
// OpenImageIO where clrt was built with it.  That is a module which a process of its own opens
// while the picture is traced: loading it takes 0.17 s and 132 MB that few runs need pay.
#pragma once

#include "image/framebuffer.h"
#include "image/layers.h"

typedef enum { ENCODE_RAW, ENCODE_SRGB } Encoding;

// A name and value kept in files: PNG and EXR by name, TIFF and JPEG as lines of the description.
typedef struct {
    const char *name, *value;
} ImageText;

typedef struct {
    const char *format; // png, jpg, tif, ppm, exr, hdr or pfm
    Encoding encoding;  // of 8-bit formats; floats are written as they are
    const ImageText *texts;
    size_t text_count;
    // Where the picture lies in a whole one of that size, in formats that tell; 0: it is whole.
    uint32_t left, top, whole_width, whole_height;
    const Layers *layers; // channels beside the colors, in formats that take them; NULL for none
} ImageSettings;

// The format a path's ending names, NULL where there is none or clrt does not write it.
const char *image_format_of_path(const char *path);

// The format called name (also jpeg, tiff), NULL where clrt does not write it.
const char *image_format_named(const char *name);

// Whether a format that clrt writes holds floats.
bool image_format_is_float(const char *format);
// Whether files of that format take layers: EXR alone.
bool image_format_takes_layers(const char *name);

// All format names this build writes, for messages.
const char *image_format_names(void);

// Half of the smallest step between the values from 0 to 1 that the format holds: what no file
// shows.
double image_format_half_step(const char *format, Encoding encoding);

// Starts loading what writing the format needs, in another process; returns at once.  For main
// alone, while no other thread runs.
void image_prepare(const char *format);

// Whether the format has room for a picture of that size.
bool image_check_size(const char *format, uint32_t width, uint32_t height, Error *error);

// Writes the picture to path ("-": standard output), as base/output_file.h does.
bool image_write(const Framebuffer *framebuffer, const char *path, const ImageSettings *settings,
                 Error *error);
