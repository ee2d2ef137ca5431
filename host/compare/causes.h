// SPDX-License-Identifier: MIT
// Attributes the difference of two pictures with channels to causes. A pixel's whole error goes to
// the first cause that its channels show, so the causes add up to the total.
#pragma once

#include "compare/difference.h"

typedef enum {
    CAUSE_PRIMITIVE,  // the center's ray hits another primitive first
    CAUSE_SHADOW,     // other lights reach the hit point
    CAUSE_TRUNCATION, // one picture's limit ends its reflections sooner
    CAUSE_REFLECTION, // the reflections take another path
    CAUSE_COVERAGE,   // the pixel has other samples
    CAUSE_ROUNDING,   // none of these; within one scene this is rounding
    CAUSE_KINDS
} CauseKind;

typedef struct {
    bool known;                   // both files have the channels
    double squares[CAUSE_KINDS];  // parts of the mean square error
    uint64_t pixels[CAUSE_KINDS]; // that differ at all
} Causes;

// Splits the error of a checked pair, as far as the files' channels allow.
void causes_find(Causes *causes, const ImagePair *pair);

// Return a cause's name in reports, and its meaning.
const char *cause_name(CauseKind kind);
const char *cause_meaning(CauseKind kind);
