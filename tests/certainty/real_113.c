// SPDX-License-Identifier: MIT
// Computes the decisions of a ray tree (real_text.h) in __float128, whose relative rounding errors
// are at most 2^-113.
#include <math.h>

__extension__ typedef __float128 Quad;

// Returns the square root, or 0 if a is not positive. Starts from the root in long double. A step
// of Newton's method doubles the number of correct bits, up to the 113 bits of Quad.
static Quad root(Quad a)
{
    if (!(a > 0))
        return 0;
    Quad x = sqrtl((long double)a);
    x = (x + a / x) / 2;
    return (x + a / x) / 2;
}

#define NUMBER    Quad
#define ROOT(x)   root(x)
#define TOLERANCE 0x1p-100L
#define DECIDE    real_decide_113
#include "certainty/real_text.h"
