// SPDX-License-Identifier: MIT
// --crop "X0,Y0,X1,Y1". The numbers are pixels, or fractions of the sides if any of them has a dot.
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

// Replaces the settings of a whole picture by the crop's settings. Rounds fractions to the nearest
// pixel edge, so adjacent crops neither overlap nor leave gaps.
bool crop_apply(const Crop *crop, RenderSettings *settings, Error *error);

// Returns [left, top, right, bottom] of the crop, in pixels of the whole picture.
json_t *crop_json(const RenderSettings *settings);
