// SPDX-License-Identifier: MIT
// Two pictures -> how much they differ.  Values are those that the files store, 8 bits v as
// v / 255, and all three colors count alike.
#pragma once

#include "image/stored_image.h"

// Pixels are off by more than one and by more than four steps of 8 bits in some color.  What two
// files of 8 bits store is rounded, so a step is counted as one with this on top.
#define DIFFERENCE_ROUNDING 0x1p-22

// The channel of first hits in files with more than colors.
#define DIFFERENCE_HITS "primitive"

typedef struct {
    uint32_t width, height;
    uint64_t pixels;
    double rmse;
    double maximum;
    uint32_t maximum_x, maximum_y, maximum_color; // where, the first in reading order
    uint64_t off_by_1, off_by_4;                  // pixels
    bool has_hits;                                // both files tell what each pixel's ray meets
    uint64_t wrong_hits;                          // pixels where that differs
} Difference;

// The two pictures, and where their colors are.
typedef struct {
    const StoredImage *images[2];
    const char *paths[2];
    uint32_t colors[2][3];
} ImagePair;

// False, with a sentence that names the file, where sizes differ, where there are no colors and
// where some are not finite.
bool image_pair_check(ImagePair *pair, Error *error);

// What a checked pair differs by.
void difference_measure(Difference *difference, const ImagePair *pair);

// Decibels below 1; infinite for equal pictures.
double difference_psnr(const Difference *difference);

// The difference of one color, the second picture's value less the first's.
double image_pair_difference(const ImagePair *pair, size_t pixel, int color);
