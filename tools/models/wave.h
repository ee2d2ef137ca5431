// SPDX-License-Identifier: MIT
// Sine, cosine and the angle of a vector by fixed polynomials. Angles are in turns: 1 is a full
// circle. The last bits of the C library's sin and atan2 differ between systems. These functions
// use only + - * / and floor, so a model is the same file everywhere. Their error is below 1e-6,
// which is invisible in a mesh.
#pragma once

#include <math.h>

#define WAVE_TAU 6.28318530717958647692

// Folds the angle to at most a quarter turn either way, and evaluates an odd Taylor polynomial.
static inline double wave_sine(double turns)
{
    double folded = turns - floor(turns + 0.5);
    if (folded > 0.25)
        folded = 0.5 - folded;
    if (folded < -0.25)
        folded = -0.5 - folded;
    const double x = folded * WAVE_TAU, s = x * x;
    return x * (1 - s / 6 * (1 - s / 20 * (1 - s / 42 * (1 - s / 72 * (1 - s / 110)))));
}

static inline double wave_cosine(double turns)
{
    return wave_sine(turns + 0.25);
}

// Returns the angle from the x axis to (x, y) in turns, from -0.5 to 0.5; 0 for the zero vector.
// The arc tangent on [0, 1] is polynomial 4.4.49 of Abramowitz and Stegun (Handbook, 1964), with an
// error below 2e-8.
static inline double wave_turns(double y, double x)
{
    const double across = fabs(x), up = fabs(y);
    const double longer = across > up ? across : up, shorter = across > up ? up : across;
    if (!(longer > 0))
        return 0;
    const double t = shorter / longer, s = t * t;
    const double sum =
        s * (-0.3333314528 +
             s * (0.1999355085 +
                  s * (-0.1420889944 +
                       s * (0.1065626393 +
                            s * (-0.0752896400 +
                                 s * (0.0429096138 + s * (-0.0161657367 + s * 0.0028662257)))))));
    double turns = t * (1 + sum) / WAVE_TAU;
    turns = across > up ? turns : 0.25 - turns;
    turns = x < 0 ? 0.5 - turns : turns;
    return y < 0 ? -turns : turns;
}
