// SPDX-License-Identifier: MIT
// Attributes the difference of two pictures with channels to causes. A pixel's whole error counts
// for the first cause that its channels show, so the causes add up to the total.
#pragma once

#include "compare/difference.h"

typedef enum {
    CAUSE_PRIMITIVE,  // the rays through the center hit different primitives
    CAUSE_SHADOW,     // different lights reach the hit point
    CAUSE_TRUNCATION, // one picture's --max-level ends its reflections sooner
    CAUSE_REFLECTION, // the reflections differ for another reason
    CAUSE_COVERAGE,   // the pictures have different samples there
    CAUSE_ROUNDING,   // none of these: rounding, if both show the same scene
    CAUSE_KINDS
} CauseKind;

typedef struct {
    bool known;                   // both files have the required channels
    double squares[CAUSE_KINDS];  // each cause's part of the mean square error
    uint64_t pixels[CAUSE_KINDS]; // pixels that differ at all, by cause
} Causes;

// Splits the error of a pair that image_pair_check has accepted.
void causes_find(Causes *causes, const ImagePair *pair);

// Return the cause's name and its meaning, as reports print them.
const char *cause_name(CauseKind kind);
const char *cause_meaning(CauseKind kind);
