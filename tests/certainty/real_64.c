// SPDX-License-Identifier: MIT
// Decisions in long double: every rounding is below 2^-64.
#define NUMBER    long double
#define ROOT(x)   sqrtl(x)
#define TOLERANCE 0x1p-54L
#define DECIDE    real_decide_64
#include "certainty/real_text.h"

RealDecisions real_decide(const RealView *view, uint32_t column, uint32_t row)
{
    const RealDecisions decisions = real_decide_64(view, column, row);
    return decisions.settled ? decisions : real_decide_113(view, column, row);
}
