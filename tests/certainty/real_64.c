// SPDX-License-Identifier: MIT
// Decides ray trees in long double, whose relative rounding errors are at most 2^-64.
#define NUMBER    long double
#define ROOT(x)   sqrtl(x)
#define TOLERANCE 0x1p-54L
#define DECIDE    real_decide_64
#include "certainty/real_text.h"
