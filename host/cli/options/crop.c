// SPDX-License-Identifier: MIT
// Parses a crop in pixels or in parts of the picture, and applies the crop to a request.
#include "cli/options/options.h"

#include "base/number.h"

#include <string.h>

bool crop_parse(Crop *crop, const char *text)
{
    const char *end = text + strlen(text);
    *crop = (Crop){.is_given = true, .in_parts = strchr(text, '.') != NULL};
    for (int i = 0; i < 4; i++) {
        int64_t pixels = 0;
        text = crop->in_parts ? number_parse(text, end, &crop->corners[i])
                              : integer_parse(text, end, &pixels);
        if (text == NULL || *text != (i < 3 ? ',' : '\0'))
            return false;
        text++;
        crop->corners[i] = crop->in_parts ? crop->corners[i] : (double)pixels;
        const double most = crop->in_parts ? 1 : PICTURE_SIZE_MAX;
        if (!(crop->corners[i] >= 0 && crop->corners[i] <= most))
            return false;
    }
    return crop->corners[0] < crop->corners[2] && crop->corners[1] < crop->corners[3];
}

static uint32_t edge_of(const Crop *crop, int corner, uint32_t side)
{
    const double place = crop->corners[corner];
    return (uint32_t)(crop->in_parts ? place * side + 0.5 : place);
}

bool crop_apply(const Crop *crop, ClrtPicture *picture, Error *error)
{
    const uint32_t width = picture->width, height = picture->height;
    if (!crop->is_given)
        return true;
    const uint32_t left = edge_of(crop, 0, width), top = edge_of(crop, 1, height),
                   right = edge_of(crop, 2, width), bottom = edge_of(crop, 3, height);
    if (right > width || bottom > height)
        return error_set(error, "the crop %u,%u,%u,%u exceeds the picture of %u x %u pixels", left,
                         top, right, bottom, width, height);
    if (left == right || top == bottom)
        return error_set(error, "no pixel of the picture of %u x %u is in the crop", width, height);
    picture->left = left;
    picture->top = top;
    picture->crop_width = right - left;
    picture->crop_height = bottom - top;
    return true;
}

json_t *crop_json(const RenderSettings *settings)
{
    return json_pack("[iiii]", (int)settings->left, (int)settings->top,
                     (int)(settings->left + settings->width),
                     (int)(settings->top + settings->height));
}
