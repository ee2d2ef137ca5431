// SPDX-License-Identifier: MIT
// Numbers whose relative rounding errors are at most 2^-113.
#pragma once

#include <float.h>
#include <math.h>

#if LDBL_MANT_DIG == 113
typedef long double Quad;
#else
__extension__ typedef __float128 Quad;
#endif

// Returns the square root, or 0 if a is not positive. Starts from the root in long double. A step
// of Newton's method doubles the number of correct bits, up to the 113 bits of Quad.
static inline Quad quad_root(Quad a)
{
    if (!(a > 0))
        return 0;
    Quad x = sqrtl((long double)a);
    x = (x + a / x) / 2;
    return (x + a / x) / 2;
}
