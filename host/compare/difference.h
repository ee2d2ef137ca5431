// SPDX-License-Identifier: MIT
// Measures the difference of two pictures. Values are as stored in the files, with an 8-bit v as v
// / 255. All three colors have equal weight.
#pragma once

#include "image/framebuffer.h"
#include "image/stored_image.h"

// Tolerance of the counts of pixels that differ by more than one and by more than four 8-bit steps
// in some color. 8-bit files store rounded values, so a step counts as one up to this excess.
#define DIFFERENCE_ROUNDING 0x1p-22

// The channel of first hits, in files with more than colors.
#define DIFFERENCE_HITS "primitive"

typedef struct {
    uint32_t width, height;
    uint64_t pixels;
    double rmse;
    double maximum;
    uint32_t maximum_x, maximum_y, maximum_color; // its position, the first in reading order
    uint64_t off_by_1, off_by_4;                  // pixels
    bool has_hits;                                // both files have the channel of first hits
    uint64_t wrong_hits;                          // pixels with different first hits
} Difference;

// The two pictures, and the indices of their colors.
typedef struct {
    const StoredImage *images[2];
    const char *paths[2];
    uint32_t colors[2][3];
} ImagePair;

// Returns false with a message that names the file if sizes differ, colors are missing or values
// are not finite.
bool image_pair_check(ImagePair *pair, Error *error);

// Measures the difference of a checked pair.
void difference_measure(Difference *difference, const ImagePair *pair);

// Returns the signal-to-noise ratio in decibels, for a peak of 1; infinite for equal pictures.
double difference_psnr(const Difference *difference);

// Returns the difference of one color: the second picture's value minus the first's.
double image_pair_difference(const ImagePair *pair, size_t pixel, int color);

// Makes a picture of the difference of two pictures. All have the same scale, so that two maps can
// be compared.  Each color is the absolute difference for float files. With for_the_eye it is the
// square root: 1/255 maps to 1/8, 4/255 to 1/4, and everything from 64/255 to 1.
bool difference_picture_make(Framebuffer *picture, const ImagePair *pair, bool for_the_eye,
                             Error *error);
