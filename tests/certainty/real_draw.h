// SPDX-License-Identifier: MIT
// A certified picture beside real arithmetic, on all processors.
#pragma once

#include "certainty/certified.h"
#include "certainty/real.h"

typedef struct {
    uint64_t compared;  // pixels, certified or repaired
    uint64_t first;     // of those: another first hit, or another light seen there
    uint64_t deeper;    // of those: any other decision of the ray tree
    uint64_t unsettled; // of those: not even 113 bits settle the first hit and its lights
    uint64_t in_113;    // of those: 64 bits did not settle the ray tree
} Comparison;

// Compares every step-th pixel of every step-th row.
bool real_compare(Comparison *comparison, const Certified *certified, uint32_t step, Error *error);
