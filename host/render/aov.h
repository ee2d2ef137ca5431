// SPDX-License-Identifier: MIT
// The channels that --aov adds to a picture (arbitrary output variables, as film renderers call
// them): one table that says what each is called and where its values come from.
#pragma once

#include "image/layers.h"
#include "scene/normalize.h"

// What channels are made of, for one pixel.
typedef struct {
    const PathData *path;  // of the ray through its center
    const uint32_t *tests; // TALLY_KINDS counts over all its samples; NULL where none is asked for
    uint32_t samples;
    uint32_t certainty; // of all its samples, a Certainty
} AovPixel;

// The same for all pixels.
typedef struct {
    const Normalization *normalization;
    uint32_t light_count;
} AovScene;

#define AOV_COMPONENTS 3

// The last in the table: each pixel's error against the reference.
#define ERROR_CHANNEL "error"

// What a channel takes beside the path of the ray through a pixel's center.
typedef enum {
    AOV_NEEDS_PATH,
    AOV_NEEDS_TESTS,     // every sample is traced again, alone
    AOV_NEEDS_CERTAINTY, // every sample is certified
    AOV_NEEDS_REFERENCE  // filled in by whoever draws that
} AovNeed;

typedef struct {
    const char *name;                     // in --aov
    const char *channels[AOV_COMPONENTS]; // in the file; NULL behind the last
    bool is_integer;                      // unsigned; else float
    AovNeed need;
    const char *help;
    // Fills values, which are floats by their bits where they are no integers.
    void (*take)(uint32_t *values, const AovPixel *pixel, const AovScene *scene);
} Aov;

extern const Aov aov_table[];
extern const size_t aov_count; // at most 32

// Sets of channels have a bit for each place in the table.
typedef uint32_t AovSet;

// Adds the channels that a list names, with commas between, to set.  False and a message where a
// name is unknown or comes twice.
bool aov_read_list(const char *list, AovSet *set, Error *error);

// Whether some channel of the set has that need.
bool aov_needs(AovSet set, AovNeed need);

// Names the channels of set, in the table's order.
void aov_name_layers(AovSet set, Layers *layers);

// Fills the values that layers have for a pixel.
void aov_take(AovSet set, uint32_t *values, const AovPixel *pixel, const AovScene *scene);
