// SPDX-License-Identifier: MIT
// --aov adds channels to a picture. Film renderers call them arbitrary output variables. Separate
// kernels compute the channels, so pictures without channels take no extra time.
#pragma once

#include "render/certifier.h"
#include "scene/normalize.h"

#define AOV_COMPONENTS 3

// The name of the table's last channel. This channel holds each pixel's error against the
// reference.
#define ERROR_CHANNEL "error"

// The input that a channel needs besides the path of the ray through the pixel's center.
typedef enum {
    AOV_NEEDS_PATH,      // nothing more
    AOV_NEEDS_TESTS,     // counts of tests; every sample is traced again as a single ray
    AOV_NEEDS_CERTAINTY, // certainty of all samples
    AOV_NEEDS_REFERENCE  // the reference; the code that draws the reference also fills the channel
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

// Returns whether a channel in `set` has the need `need`.
bool aov_needs(AovSet set, AovNeed need);

// Appends the names and types of the channels in `set` to `layers`, in the table's order.
void aov_name_layers(AovSet set, Layers *layers);

// The kernels trace_paths and count_tests can share a program. count_tests needs
// SceneTraits::statistics.
extern const KernelEntry paths_entry, tests_entry;

typedef struct {
    AovSet set;
    Layers *layers;          // has the names of `set` (aov_name_layers) and the picture's size
    Renderer paths;          // with paths_entry and the picture's settings
    const Kernel *tests;     // with tests_entry; NULL unless a channel needs it
    CameraData camera;       // the picture's camera
    CameraData center;       // the same camera with one sample per pixel
    const uint32_t *samples; // sample counts of the pixels, row by row; NULL if all are equal
    const Normalization *normalization;
    uint32_t light_count;
    const CertaintyMap *certainty; // the picture's map; NULL if no channel needs it
} AovPass;

// Computes the channels tile by tile. Stops when the observer returns false. Floats are stored as
// their bits, and the error as 0.
bool aov_draw(AovPass *pass, const RenderObserver *observer, Error *error);
