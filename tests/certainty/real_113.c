// SPDX-License-Identifier: MIT
// Computes the decisions of a ray tree (real_text.h) with relative rounding errors of at most
// 2^-113.
#include "oracle/quad.h"

#define NUMBER    Quad
#define ROOT(x)   quad_root(x)
#define TOLERANCE 0x1p-100L
#define DECIDE    real_decide_113
#include "certainty/real_text.h"
