// SPDX-License-Identifier: MIT
// The settings of a picture, a part or a crop, as the kernels draw it.
#pragma once

#include <stdbool.h>
#include <stdint.h>

typedef struct {
    uint32_t width, height;             // size of the crop
    uint32_t left, top;                 // position of the crop in the whole picture
    uint32_t whole_width, whole_height; // size of the whole picture; 0 without a crop
    uint32_t samples;                   // along each side of a pixel
    uint32_t max_level; // rays of this level return the background; camera rays have level 0
    uint32_t tile_width, tile_height; // by default those of session/request.c
    uint64_t ready_tiles;             // number of leading tiles that exist already and are skipped
    uint32_t part, parts; // draws one of `parts` parts (see Tile); all tiles if both are 0
} RenderSettings;

// These two functions return the size of the whole picture.
static inline uint32_t render_whole_width(const RenderSettings *settings)
{
    return settings->whole_width > 0 ? settings->whole_width : settings->width;
}

static inline uint32_t render_whole_height(const RenderSettings *settings)
{
    return settings->whole_height > 0 ? settings->whole_height : settings->height;
}

static inline bool render_is_part(const RenderSettings *settings)
{
    return settings->width < render_whole_width(settings) ||
           settings->height < render_whole_height(settings);
}

// The largest RenderSettings::samples. This limit keeps sample coordinates exact in float.
#define SAMPLES_MAX 64

// The largest RenderSettings::parts.
#define PARTS_MAX 65536
