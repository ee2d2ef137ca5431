// SPDX-License-Identifier: MIT
// The channels primitive, shadow and bounces describe only the ray through a pixel's center. If
// they agree, the pixel's samples determine the cause. If both pictures have the same samples, even
// a large difference is rounding, because rounding can change a sample's hit. Otherwise, every
// difference above rounding counts as coverage.
#include "compare/difference.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// Rounding changes a color in [0, 1] by at most this much, unless it changes a hit or a shadow.
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
    int level;              // value of --max-level; -1 if not recorded
} Side;

// Returns the integer after `name` in the settings, which are JSON without blanks; -1 if none.
static int setting_of(const StoredImage *image, const char *name)
{
    char pattern[32];
    int value = -1;
    const char *word = strstr(image->texts[STORED_SETTINGS], name);
    snprintf(pattern, sizeof pattern, "%s%%9d", name);
    return word != NULL && sscanf(word, pattern, &value) == 1 ? value : -1;
}

static Side side_of(const StoredImage *image)
{
    return (Side){.image = image,
                  .channels = {stored_image_channel(image, DIFFERENCE_HITS),
                               stored_image_channel(image, "shadow"),
                               stored_image_channel(image, "bounces"),
                               stored_image_channel(image, "samples")},
                  .level = setting_of(image, "\"max_level\":")};
}

static bool is_complete(const Side *side)
{
    return side->channels[PRIMITIVE] >= 0 && side->channels[SHADOW] >= 0 &&
           side->channels[BOUNCES] >= 0;
}

static float value_at(const Side *side, size_t pixel, int channel)
{
    const StoredImage *image = side->image;
    return image->values[pixel * image->channel_count + (size_t)side->channels[channel]];
}

// Compares bits, because channels may hold integers.
static bool differ(const Side sides[2], size_t pixel, int channel)
{
    const float a = value_at(&sides[0], pixel, channel), b = value_at(&sides[1], pixel, channel);
    return memcmp(&a, &b, sizeof a) != 0;
}

// Returns whether the shorter path ended at its --max-level, and the other --max-level is higher.
static bool is_truncated(const Side sides[2], size_t pixel)
{
    const float bounces[] = {value_at(&sides[0], pixel, BOUNCES),
                             value_at(&sides[1], pixel, BOUNCES)};
    const int shorter = bounces[0] < bounces[1] ? 0 : 1;
    return sides[shorter].level >= 0 && sides[shorter].level < sides[!shorter].level &&
           bounces[shorter] >= (float)(sides[shorter].level - 1);
}

// Returns whether the setting that determines the sample positions is equal.
static bool have_same_grid(const Side sides[2])
{
    const char *words[2];
    for (int i = 0; i < 2; i++) {
        words[i] = strstr(sides[i].image->texts[STORED_SETTINGS], "\"samples\":");
        if (words[i] == NULL)
            return false;
    }
    const size_t length = strcspn(words[0], ",}");
    return length == strcspn(words[1], ",}") && strncmp(words[0], words[1], length) == 0;
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

void causes_find(Causes *causes, const ImagePair *pair)
{
    const Side sides[] = {side_of(pair->images[0]), side_of(pair->images[1])};
    const size_t pixels = (size_t)pair->images[0]->width * pair->images[0]->height;
    *causes = (Causes){.known = is_complete(&sides[0]) && is_complete(&sides[1])};
    const bool same_grid = have_same_grid(sides);
    for (size_t pixel = 0; causes->known && pixel < pixels; pixel++) {
        double squares = 0, largest = 0;
        for (int color = 0; color < 3; color++) {
            const double off = fabs(image_pair_difference(pair, pixel, color));
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
}
