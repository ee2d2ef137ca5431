// SPDX-License-Identifier: MIT
// "rmse=0.01,share1=2%" -> limits on a difference, and which of them it breaks.
#pragma once

#include "compare/difference.h"

typedef enum {
    LIMIT_RMSE,
    LIMIT_MAX,
    LIMIT_PSNR,   // at least
    LIMIT_SHARE1, // of pixels off by more than 1/255
    LIMIT_SHARE4,
    LIMIT_HITS, // share of pixels with another first hit
    LIMIT_KINDS
} LimitKind;

typedef struct {
    bool given[LIMIT_KINDS];
    double values[LIMIT_KINDS];
} Limits;

// False where the text is not understood, with the reason alone.
bool limits_parse(Limits *limits, const char *text, Error *cause);

const char *limit_name(LimitKind kind);

// What the limit is on; NAN where the files do not tell.
double limit_measured(LimitKind kind, const Difference *difference);

// Whether the difference keeps within the limit; what is not told does not.
bool limit_is_kept(const Limits *limits, LimitKind kind, const Difference *difference);
