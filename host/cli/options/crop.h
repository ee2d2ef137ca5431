// SPDX-License-Identifier: MIT
// The part of a picture that is drawn: "X0,Y0,X1,Y1" in pixels, or in parts of the picture's sides
// where a number has a dot.
#pragma once

#include "base/error.h"
#include "render/renderer.h"

#include <jansson.h>

typedef struct {
    bool is_given;
    bool in_parts;     // of the sides, each from 0 to 1
    double corners[4]; // left, top, right and bottom; the latter two are just outside
} Crop;

// Reads the text; false where it is none.
bool crop_parse(Crop *crop, const char *text);

// Makes of the settings of a whole picture those of its part.  Parts of a side are rounded to the
// nearest edge of pixels, so that crops which share one fit together.
bool crop_apply(const Crop *crop, RenderSettings *settings, Error *error);

// The corners of what is drawn, in pixels of the whole picture.
json_t *crop_json(const RenderSettings *settings);
