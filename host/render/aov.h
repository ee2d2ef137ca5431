// SPDX-License-Identifier: MIT
// --aov adds channels to a picture. Film renderers call them arbitrary output variables. The
// functions below read lists of channels and compute a pixel's values.
#pragma once

#include "image/framebuffer.h"
#include "scene/normalize.h"

// The input for one pixel's channels.
typedef struct {
    const PathData *path; // path of the ray through the pixel's center
    uint32_t samples;
    uint32_t certainty; // the pixel's Certainty, over all samples
} AovPixel;

// The input shared by all pixels.
typedef struct {
    const Normalization *normalization;
    uint32_t light_count;
} AovScene;

#define AOV_COMPONENTS 3

// The name of the table's last channel. This channel holds each pixel's error against the
// reference.
#define ERROR_CHANNEL "error"

// The input that a channel needs besides the path of the ray through the pixel's center.
typedef enum {
    AOV_NEEDS_PATH,      // nothing more
    AOV_NEEDS_TESTS,     // counts of tests; every sample is traced again as a single ray
    AOV_NEEDS_CERTAINTY, // certificates of all samples
    AOV_NEEDS_REFERENCE  // the reference; the code that draws it also fills the channel
} AovNeed;

typedef struct {
    const char *name;                     // name in --aov
    const char *channels[AOV_COMPONENTS]; // names in the file; unused ones are NULL
    bool is_integer;                      // unsigned integers; otherwise floats
    AovNeed need;
    const char *help;
} Aov;

extern const Aov aov_table[];
extern const size_t aov_count; // at most 32

uint32_t aov_channel_count(const Aov *aov);

// A set of channels: one bit per table index.
typedef uint32_t AovSet;

// Adds the channels of a comma-separated list to *set. "all" adds all channels that need no
// reference. Fails on an unknown name or a repeated channel.
bool aov_read_list(const char *list, AovSet *set, Error *error);

// Returns whether any channel in `set` has this need.
bool aov_needs(AovSet set, AovNeed need);

// Appends the names and types of the channels in `set` to `layers`, in the table's order.
void aov_name_layers(AovSet set, Layers *layers);

// Stores one pixel's values for all channels in `set`, in the table's order. Floats are stored as
// their bits. Counts of tests and the error are stored as 0.
void aov_take(AovSet set, uint32_t *values, const AovPixel *pixel, const AovScene *scene);

// Replaces the counts of tests in `values`. `tests` holds the counts over all samples.
void aov_take_tests(AovSet set, uint32_t *values, const uint32_t tests[TALLY_KINDS]);
