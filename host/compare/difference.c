// SPDX-License-Identifier: MIT
// Sums each row in doubles, and then the rows, so that millions of values keep 12 exact digits.
#include "compare/difference.h"

#include "base/number.h"

#include <math.h>
#include <string.h>

static float value_at(const StoredImage *image, size_t pixel, uint32_t channel)
{
    return image->values[pixel * image->channel_count + channel];
}

double image_pair_difference(const ImagePair *pair, size_t pixel, int color)
{
    return (double)value_at(pair->images[1], pixel, pair->colors[1][color]) -
           (double)value_at(pair->images[0], pixel, pair->colors[0][color]);
}

static bool check_finite(const ImagePair *pair, int side, Error *error)
{
    const StoredImage *image = pair->images[side];
    const size_t pixels = (size_t)image->width * image->height;
    for (size_t pixel = 0; pixel < pixels; pixel++)
        for (int color = 0; color < 3; color++)
            if (!isfinite(value_at(image, pixel, pair->colors[side][color])))
                return error_set(error, "%s: %s of pixel %zu,%zu is not finite", pair->paths[side],
                                 image->names[pair->colors[side][color]], pixel % image->width,
                                 pixel / image->width);
    return true;
}

bool image_pair_check(ImagePair *pair, Error *error)
{
    const StoredImage *a = pair->images[0], *b = pair->images[1];
    if (a->width != b->width || a->height != b->height)
        return error_set(error, "%s has %u x %u pixels and %s has %u x %u", pair->paths[0],
                         a->width, a->height, pair->paths[1], b->width, b->height);
    for (int side = 0; side < 2; side++) {
        if (!stored_image_colors(pair->images[side], pair->colors[side]))
            return error_set(error, "%s: it has no channels R, G and B", pair->paths[side]);
        if (!check_finite(pair, side, error))
            return false;
    }
    return true;
}

// Updates the maximum and the counts with a pixel. Returns the pixel's sum of squared differences.
static double add_pixel(Difference *difference, const ImagePair *pair, size_t pixel)
{
    double squares = 0, largest = 0;
    for (int color = 0; color < 3; color++) {
        const double off = fabs(image_pair_difference(pair, pixel, color));
        squares += off * off;
        largest = fmax(largest, off);
        if (off > difference->maximum) {
            difference->maximum = off;
            difference->maximum_x = (uint32_t)(pixel % difference->width);
            difference->maximum_y = (uint32_t)(pixel / difference->width);
            difference->maximum_color = (uint32_t)color;
        }
    }
    difference->off_by_1 += largest > 1 / 255.0 + DIFFERENCE_ROUNDING;
    difference->off_by_4 += largest > 4 / 255.0 + DIFFERENCE_ROUNDING;
    return squares;
}

// Counts pixels whose first hits differ. Compares bits, because the channel may hold integers.
static void count_hits(Difference *difference, const ImagePair *pair)
{
    int places[2];
    for (int side = 0; side < 2; side++)
        places[side] = stored_image_channel(pair->images[side], DIFFERENCE_HITS);
    difference->has_hits = places[0] >= 0 && places[1] >= 0;
    for (size_t pixel = 0; difference->has_hits && pixel < difference->pixels; pixel++) {
        const float ids[] = {value_at(pair->images[0], pixel, (uint32_t)places[0]),
                             value_at(pair->images[1], pixel, (uint32_t)places[1])};
        difference->wrong_hits += memcmp(&ids[0], &ids[1], sizeof ids[0]) != 0;
    }
}

void difference_measure(Difference *difference, const ImagePair *pair)
{
    const StoredImage *image = pair->images[0];
    *difference = (Difference){.width = image->width,
                               .height = image->height,
                               .pixels = (uint64_t)image->width * image->height};
    double squares = 0;
    for (size_t row = 0; row < image->height; row++) {
        double row_squares = 0;
        for (size_t column = 0; column < image->width; column++)
            row_squares += add_pixel(difference, pair, row * image->width + column);
        squares += row_squares;
    }
    difference->rmse = sqrt(squares / (3 * (double)difference->pixels));
    count_hits(difference, pair);
}

double difference_psnr(const Difference *difference)
{
    return -20 * log10(difference->rmse);
}

#define FULL (64 / 255.0) // the difference that maps to 1

static double brighten(double difference)
{
    return fmin(1, sqrt(difference / FULL));
}

bool difference_picture_make(Framebuffer *picture, const ImagePair *pair, bool for_the_eye,
                             Error *error)
{
    const StoredImage *image = pair->images[0];
    if (!framebuffer_make(picture, image->width, image->height, error))
        return false;
    const size_t pixels = (size_t)image->width * image->height;
    for (size_t pixel = 0; pixel < pixels; pixel++)
        for (int color = 0; color < 3; color++) {
            const double off = fabs(image_pair_difference(pair, pixel, color));
            picture->pixels[pixel][color] = (float)(for_the_eye ? brighten(off) : off);
        }
    return true;
}

// Parses limits by the names that reports also use.

const char *const limit_names[LIMIT_KINDS] = {"rmse", "max", "psnr", "share1", "share4", "hits"};

static int kind_named(const char *name, size_t length)
{
    for (int kind = 0; kind < LIMIT_KINDS; kind++)
        if (strlen(limit_names[kind]) == length && strncmp(limit_names[kind], name, length) == 0)
            return kind;
    return -1;
}

// Parses one NAME=VALUE between start and end. Values other than PSNR may be in percent.
static bool parse_limit(Limits *limits, const char *start, const char *end, Error *cause)
{
    const char *equals = memchr(start, '=', (size_t)(end - start));
    const int kind = equals == NULL ? -1 : kind_named(start, (size_t)(equals - start));
    double value;
    const char *stop = kind < 0 ? NULL : number_parse(equals + 1, end, &value);
    if (stop != NULL && stop < end && *stop == '%' && kind != LIMIT_PSNR) {
        value /= 100;
        stop++;
    }
    if (stop != end || !isfinite(value) || value < 0)
        return error_set(cause,
                         "needs limits like rmse=0.01,max=0.1,psnr=40,share1=1%%,share4=0,hits=0, "
                         "not '%.*s'",
                         (int)(end - start), start);
    limits->given[kind] = true;
    limits->values[kind] = value;
    return true;
}

bool limits_parse(Limits *limits, const char *text, Error *cause)
{
    for (;;) {
        const char *end = text + strcspn(text, ",");
        if (!parse_limit(limits, text, end, cause))
            return false;
        if (*end == '\0')
            return true;
        text = end + 1;
    }
}

double limit_measured(LimitKind kind, const Difference *difference)
{
    const double pixels = (double)difference->pixels;
    const double measured[LIMIT_KINDS] = {
        [LIMIT_RMSE] = difference->rmse,
        [LIMIT_MAX] = difference->maximum,
        [LIMIT_PSNR] = difference_psnr(difference),
        [LIMIT_SHARE1] = (double)difference->off_by_1 / pixels,
        [LIMIT_SHARE4] = (double)difference->off_by_4 / pixels,
        [LIMIT_HITS] = difference->has_hits ? (double)difference->wrong_hits / pixels : NAN};
    return measured[kind];
}

bool limit_is_kept(const Limits *limits, LimitKind kind, const Difference *difference)
{
    const double measured = limit_measured(kind, difference);
    return kind == LIMIT_PSNR ? measured >= limits->values[kind] : measured <= limits->values[kind];
}
