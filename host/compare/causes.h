// SPDX-License-Identifier: MIT
// Two pictures with channels -> what their difference comes from.  Every pixel's error goes whole
// to the first cause that its channels show, so that the causes sum to the whole.
#pragma once

#include "compare/difference.h"

typedef enum {
    CAUSE_PRIMITIVE,  // the ray through the center meets another primitive first
    CAUSE_SHADOW,     // other lights reach what it meets
    CAUSE_TRUNCATION, // one picture's limit ends its reflections sooner
    CAUSE_REFLECTION, // they take another course
    CAUSE_COVERAGE,   // the pixel has other samples
    CAUSE_ROUNDING,   // none of these, which in one scene is rounding
    CAUSE_KINDS
} CauseKind;

typedef struct {
    bool known;                   // both files have the channels
    double squares[CAUSE_KINDS];  // parts of the mean square error
    uint64_t pixels[CAUSE_KINDS]; // that differ at all
} Causes;

// Splits the error of a checked pair, as far as its files tell.
void causes_find(Causes *causes, const ImagePair *pair);

// For reports, and what it means.
const char *cause_name(CauseKind kind);
const char *cause_meaning(CauseKind kind);
