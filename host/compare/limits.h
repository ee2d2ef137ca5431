// SPDX-License-Identifier: MIT
// Parses limits like "rmse=0.01,share1=2%" and checks a difference against them.
#pragma once

#include "compare/difference.h"

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

// Adds the limits in text. Returns false if the text is invalid; cause then holds the reason.
bool limits_parse(Limits *limits, const char *text, Error *cause);

const char *limit_name(LimitKind kind);

// Returns the measured value that the limit applies to; NAN if the files lack the required channel.
double limit_measured(LimitKind kind, const Difference *difference);

// Returns whether the measured value is within the limit. A missing value is not within any limit.
bool limit_is_kept(const Limits *limits, LimitKind kind, const Difference *difference);
