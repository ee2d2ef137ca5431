// SPDX-License-Identifier: MIT
// Decisions in __float128: every rounding is below 2^-113.
#define NUMBER    __float128
#define ROOT(x)   sqrtq(x)
#define TOLERANCE 0x1p-100L
#define DECIDE    real_decide_113
#pragma GCC diagnostic ignored "-Wpedantic"
#include <quadmath.h>

#include "certainty/real_text.h"
