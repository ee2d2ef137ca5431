// SPDX-License-Identifier: MIT
// The difference of two pictures. Values are compared as the files store them, and an 8-bit value v
// counts as v / 255. All three colors have equal weight.
#pragma once

#include "image/framebuffer.h"
#include "image/stored_image.h"

// The counts off_by_1 and off_by_4 tolerate this additional difference. After rounding to float,
// values that are one 8-bit step apart can differ by slightly more than 1/255.
#define DIFFERENCE_ROUNDING 0x1p-22

// The name of the channel with the ids of first hits.
#define DIFFERENCE_HITS "primitive"

typedef struct {
    uint32_t width, height;
    uint64_t pixels;
    double rmse;
    double maximum;
    uint32_t maximum_x, maximum_y, maximum_color; // where the maximum first occurs
    uint64_t off_by_1, off_by_4; // pixels off by more than 1/255, and by more than 4/255
    bool has_hits;               // both files have the channel of first hits
    uint64_t wrong_hits;         // pixels with different first hits
} Difference;

// The two pictures, and the channel indices of their colors.
typedef struct {
    const StoredImage *images[2];
    const char *paths[2];
    uint32_t colors[2][3];
} ComparedImages;

// Fills compared->colors. Returns false if sizes differ, colors are missing or values are not
// finite. The error message names the file.
bool compared_images_check(ComparedImages *compared, Error *error);

// Measures images that compared_images_check has accepted.
void difference_measure(Difference *difference, const ComparedImages *compared);

// Returns the PSNR in decibels, for a peak of 1; INFINITY for equal pictures.
double difference_psnr(const Difference *difference);

// Makes a picture of the absolute differences of two pictures. With `for_the_eye`, each color is
// sqrt(difference / (64/255)), at most 1. This scale does not depend on the pictures, so users can
// compare several such results.
bool difference_picture_make(Framebuffer *picture, const ComparedImages *compared, bool for_the_eye,
                             Error *error);

typedef enum {
    LIMIT_RMSE,
    LIMIT_MAX,
    LIMIT_PSNR,   // a lower limit; all others are upper limits
    LIMIT_SHARE1, // share of pixels off by more than 1/255
    LIMIT_SHARE4,
    LIMIT_HITS, // share of pixels whose first hits differ
    LIMIT_KINDS
} LimitKind;

typedef struct {
    bool given[LIMIT_KINDS];
    double values[LIMIT_KINDS];
} Limits;

// Parses limits such as "rmse=0.01,max=10%" and adds them to *limits. If `text` is invalid, returns
// false and stores the reason in *cause.
bool limits_parse(Limits *limits, const char *text, Error *cause);

// The names of limits in --fail and in reports.
extern const char *const limit_names[LIMIT_KINDS];

// Returns the measured value to which the limit applies, or NAN if the files lack the channel for
// this limit.
double limit_measured(LimitKind kind, const Difference *difference);

// Returns whether the measured value is within the limit. NAN is outside every limit.
bool limit_is_kept(const Limits *limits, LimitKind kind, const Difference *difference);

// The cause of a pixel's difference.
typedef enum {
    CAUSE_PRIMITIVE,  // the rays through the pixel's center hit different primitives
    CAUSE_SHADOW,     // different lights reach the hit point
    CAUSE_TRUNCATION, // the pictures have different --max-level, so reflections end sooner in one
                      // of them
    CAUSE_REFLECTION, // the reflections differ for another reason
    CAUSE_COVERAGE,   // the pictures have different samples of the pixel
    CAUSE_ROUNDING,   // no other cause: rounding, if both pictures show the same scene
    CAUSE_KINDS
} CauseKind;

typedef struct {
    bool known;                   // both files have the channels that show causes
    double squares[CAUSE_KINDS];  // each cause's part of the mean square error
    uint64_t pixels[CAUSE_KINDS]; // pixels with any difference, by cause
} Causes;

// Splits the error of two images by cause. compared_images_check must have accepted the pair.
void causes_find(Causes *causes, const ComparedImages *compared);

// The causes' names and meanings, as reports print them.
extern const char *const cause_names[CAUSE_KINDS], *const cause_meanings[CAUSE_KINDS];
