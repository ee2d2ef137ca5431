// SPDX-License-Identifier: MIT
// Scalar is the tracer's number type: float, or double in the reference mode. Both modes compile
// the same source for the same scene, which is stored in float. Their difference is therefore the
// error of float arithmetic alone.
#ifndef CLRT_PRECISION_H
#define CLRT_PRECISION_H
#include "config.h"

#if CLRT_FP64
typedef double Scalar;
#define UNIT_ROUNDOFF    0x1p-53
#define SIGNIFICAND_BITS 52
#define EXPONENT_BIAS    1023
#define EXPONENT_MASK    0x7ff0000000000000ul
#define BITS_OF_ONE      0x3ff0000000000000ul
#define INVERSE_LN2      0x1.71547652b82fep+0
#define LN2_HIGH         0x1.62e42fefa39efp-1
#define LN2_LOW          0x1.abc9e3b39803fp-56
#else
typedef float Scalar;
#define UNIT_ROUNDOFF    0x1p-24f
#define SIGNIFICAND_BITS 23
#define EXPONENT_BIAS    127
#define EXPONENT_MASK    0x7f800000u
#define BITS_OF_ONE      0x3f800000u
#define INVERSE_LN2      0x1.715476p+0f
#define LN2_HIGH         0x1.62e430p-1f
#define LN2_LOW          (-0x1.05c610p-29f)
#endif

#endif
