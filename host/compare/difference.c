// SPDX-License-Identifier: MIT
// Measures the difference of two pictures, compares it with limits, and splits it by cause.
// difference_measure first sums squares within each row, so that sums of millions of squares keep
// 12 correct digits.
#include "compare/difference.h"

#include "base/number.h"
#include "base/text.h"

#include <jansson.h>
#include <math.h>
#include <string.h>

static float value_at(const StoredImage *image, size_t pixel, uint32_t channel)
{
    return image->values[pixel * image->channel_count + channel];
}

// Returns the absolute difference of one color.
static double difference_of(const ComparedImages *compared, size_t pixel, int color)
{
    return fabs((double)value_at(compared->images[1], pixel, compared->colors[1][color]) -
                (double)value_at(compared->images[0], pixel, compared->colors[0][color]));
}

static bool check_finite(const ComparedImages *compared, int side, Error *error)
{
    const StoredImage *image = compared->images[side];
    const size_t pixels = (size_t)image->width * image->height;
    for (size_t pixel = 0; pixel < pixels; pixel++)
        for (int color = 0; color < 3; color++)
            if (!isfinite(value_at(image, pixel, compared->colors[side][color])))
                return error_set(error, "%s: %s of pixel %zu,%zu is not finite",
                                 compared->paths[side], image->names[compared->colors[side][color]],
                                 pixel % image->width, pixel / image->width);
    return true;
}

bool compared_images_check(ComparedImages *compared, Error *error)
{
    const StoredImage *a = compared->images[0], *b = compared->images[1];
    if (a->width != b->width || a->height != b->height)
        return error_set(error, "%s has %u x %u pixels and %s has %u x %u", compared->paths[0],
                         a->width, a->height, compared->paths[1], b->width, b->height);
    for (int side = 0; side < 2; side++) {
        if (!stored_image_colors(compared->images[side], compared->colors[side]))
            return error_set(error, "%s: it has no channels R, G and B", compared->paths[side]);
        if (!check_finite(compared, side, error))
            return false;
    }
    return true;
}

// Updates the maximum and the counts for a pixel. Returns the pixel's sum of squared differences.
static double add_pixel(Difference *difference, const ComparedImages *compared, size_t pixel)
{
    double squares = 0, largest = 0;
    for (int color = 0; color < 3; color++) {
        const double off = difference_of(compared, pixel, color);
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

// Counts pixels with different first hits. Compares bits, because the channel may contain integers.
static void count_hits(Difference *difference, const ComparedImages *compared)
{
    int places[2];
    for (int side = 0; side < 2; side++)
        places[side] = stored_image_channel(compared->images[side], DIFFERENCE_HITS);
    difference->has_hits = places[0] >= 0 && places[1] >= 0;
    for (size_t pixel = 0; difference->has_hits && pixel < difference->pixels; pixel++) {
        const float ids[] = {value_at(compared->images[0], pixel, (uint32_t)places[0]),
                             value_at(compared->images[1], pixel, (uint32_t)places[1])};
        difference->wrong_hits += memcmp(&ids[0], &ids[1], sizeof ids[0]) != 0;
    }
}

void difference_measure(Difference *difference, const ComparedImages *compared)
{
    const StoredImage *image = compared->images[0];
    *difference = (Difference){.width = image->width,
                               .height = image->height,
                               .pixels = (uint64_t)image->width * image->height};
    double squares = 0;
    for (size_t row = 0; row < image->height; row++) {
        double row_squares = 0;
        for (size_t column = 0; column < image->width; column++)
            row_squares += add_pixel(difference, compared, row * image->width + column);
        squares += row_squares;
    }
    difference->rmse = sqrt(squares / (3 * (double)difference->pixels));
    count_hits(difference, compared);
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

bool difference_picture_make(Framebuffer *picture, const ComparedImages *compared, bool for_the_eye,
                             Error *error)
{
    const StoredImage *image = compared->images[0];
    if (!framebuffer_make(picture, image->width, image->height, error))
        return false;
    const size_t pixels = (size_t)image->width * image->height;
    for (size_t pixel = 0; pixel < pixels; pixel++)
        for (int color = 0; color < 3; color++) {
            const double off = difference_of(compared, pixel, color);
            picture->pixels[pixel][color] = (float)(for_the_eye ? brighten(off) : off);
        }
    return true;
}

// The following functions parse limits, and compare a difference with them.

const char *const limit_names[LIMIT_KINDS] = {"rmse", "max", "psnr", "share1", "share4", "hits"};

static int kind_named(const char *name, size_t length)
{
    for (int kind = 0; kind < LIMIT_KINDS; kind++)
        if (text_is(name, length, limit_names[kind]))
            return kind;
    return -1;
}

// Parses the text NAME=VALUE from `start` to `end`. Values other than PSNR may be in percent.
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

// The following functions find the cause of each pixel's difference. The channels primitive, shadow
// and bounces describe only the ray through a pixel's center. In this order, the first channel that
// differs determines the cause. If all three agree and both pictures have the same samples, the
// cause is rounding. Such a difference may be large, because rounding can change a sample's hit. If
// all three agree but the samples differ, every difference above ROUNDING_MOST counts as coverage.

// The largest change of a color in [0, 1] by rounding, if rounding changes no hit and no shadow.
#define ROUNDING_MOST 1e-5

const char *const cause_names[CAUSE_KINDS] = {"primitive",  "shadow",   "truncation",
                                              "reflection", "coverage", "rounding"};
const char *const cause_meanings[CAUSE_KINDS] = {
    "another primitive is hit first",
    "other lights reach the hit",
    "--max-level ends its reflections",
    "its reflections differ",
    "the samples differ",
    "the same samples: rounding, if the scene is the same"};

// The channels that show causes.
enum { PRIMITIVE, SHADOW, BOUNCES, SAMPLES, CHANNELS };

typedef struct {
    const StoredImage *image;
    int channels[CHANNELS]; // indices; -1 if missing
    json_t *settings;       // NULL if the file has none; owned
    int level;              // value of --max-level; -1 if not recorded
} Side;

static Side side_of(const StoredImage *image)
{
    Side side = {.image = image,
                 .channels = {stored_image_channel(image, DIFFERENCE_HITS),
                              stored_image_channel(image, "shadow"),
                              stored_image_channel(image, "bounces"),
                              stored_image_channel(image, "samples")},
                 .settings = json_loads(image->texts[STORED_SETTINGS], 0, NULL),
                 .level = -1};
    json_unpack(side.settings, "{s:i}", "max_level", &side.level);
    return side;
}

static bool is_complete(const Side *side)
{
    return side->channels[PRIMITIVE] >= 0 && side->channels[SHADOW] >= 0 &&
           side->channels[BOUNCES] >= 0;
}

static float side_value(const Side *side, size_t pixel, int channel)
{
    const StoredImage *image = side->image;
    return image->values[pixel * image->channel_count + (size_t)side->channels[channel]];
}

// Compares bits, because channels may contain integers.
static bool differ(const Side sides[2], size_t pixel, int channel)
{
    const float a = side_value(&sides[0], pixel, channel),
                b = side_value(&sides[1], pixel, channel);
    return memcmp(&a, &b, sizeof a) != 0;
}

// Each picture has a path of rays at this pixel. Returns whether --max-level ended the shorter
// path, and the picture with the longer path has a higher --max-level.
static bool is_truncated(const Side sides[2], size_t pixel)
{
    const float bounces[] = {side_value(&sides[0], pixel, BOUNCES),
                             side_value(&sides[1], pixel, BOUNCES)};
    const int shorter = bounces[0] < bounces[1] ? 0 : 1;
    return sides[shorter].level >= 0 && sides[shorter].level < sides[!shorter].level &&
           bounces[shorter] >= (float)(sides[shorter].level - 1);
}

static bool has_same_samples(const Side sides[2], size_t pixel)
{
    return sides[0].channels[SAMPLES] < 0 || sides[1].channels[SAMPLES] < 0 ||
           !differ(sides, pixel, SAMPLES);
}

// Returns the first cause that the channels show, or CAUSE_COVERAGE if the channels agree.
static CauseKind cause_in_channels(const Side sides[2], size_t pixel)
{
    if (differ(sides, pixel, PRIMITIVE))
        return CAUSE_PRIMITIVE;
    if (differ(sides, pixel, SHADOW))
        return CAUSE_SHADOW;
    if (differ(sides, pixel, BOUNCES))
        return is_truncated(sides, pixel) ? CAUSE_TRUNCATION : CAUSE_REFLECTION;
    return CAUSE_COVERAGE;
}

void causes_find(Causes *causes, const ComparedImages *compared)
{
    const Side sides[] = {side_of(compared->images[0]), side_of(compared->images[1])};
    const size_t pixels = (size_t)compared->images[0]->width * compared->images[0]->height;
    *causes = (Causes){.known = is_complete(&sides[0]) && is_complete(&sides[1])};
    const bool same_grid = json_equal(json_object_get(sides[0].settings, "samples"),
                                      json_object_get(sides[1].settings, "samples"));
    for (size_t pixel = 0; causes->known && pixel < pixels; pixel++) {
        double squares = 0, largest = 0;
        for (int color = 0; color < 3; color++) {
            const double off = difference_of(compared, pixel, color);
            squares += off * off / (3 * (double)pixels);
            largest = fmax(largest, off);
        }
        CauseKind cause = cause_in_channels(sides, pixel);
        if (cause == CAUSE_COVERAGE &&
            ((same_grid && has_same_samples(sides, pixel)) || largest <= ROUNDING_MOST))
            cause = CAUSE_ROUNDING;
        causes->squares[cause] += squares;
        causes->pixels[cause] += largest > 0;
    }
    json_decref(sides[0].settings);
    json_decref(sides[1].settings);
}
