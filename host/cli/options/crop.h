// SPDX-License-Identifier: MIT
// The crop of a picture: "X0,Y0,X1,Y1" in pixels, or in fractions of the sides if a number has a
// dot.
#pragma once

#include "base/error.h"
#include "render/renderer.h"

#include <jansson.h>

typedef struct {
    bool is_given;
    bool in_parts;     // fractions of the sides, each from 0 to 1
    double corners[4]; // left, top, right and bottom; right and bottom are exclusive
} Crop;

// Parses text; returns false if it is malformed.
bool crop_parse(Crop *crop, const char *text);

// Turns the settings of a whole picture into those of its crop.  Fractions are rounded to the
// nearest pixel edge, so adjacent crops fit together.
bool crop_apply(const Crop *crop, RenderSettings *settings, Error *error);

// Returns the corners of the crop, in pixels of the whole picture.
json_t *crop_json(const RenderSettings *settings);
