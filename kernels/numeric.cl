// SPDX-License-Identifier: MIT
// Arithmetic the tracer's decisions rest on.  Contraction is off, every wanted fma is written, and
// nothing but + - * / sqrt fma, comparisons and integers takes part in a picture, so that its bits
// are the same on every device that rounds these correctly.
#ifndef CLRT_NUMERIC_CL
#define CLRT_NUMERIC_CL
#include "config.h"
#include "shared.h"

#pragma OPENCL FP_CONTRACT OFF

#define UNIT_ROUNDOFF 0x1p-24f

// a * b - c * d within 1.5 ulp, hence with the exact sign (Kahan; Jeannerod, Louvet and Muller,
// "Further analysis of Kahan's algorithm for the accurate computation of 2x2 determinants", 2013).
static inline float difference_of_products(float a, float b, float c, float d)
{
    const float cd = c * d;
    const float error = fma(-c, d, cd);
    return fma(a, b, -cd) + error;
}

static inline float3 cross_product(float3 a, float3 b)
{
    return (float3)(difference_of_products(a.y, b.z, a.z, b.y),
                    difference_of_products(a.z, b.x, a.x, b.z),
                    difference_of_products(a.x, b.y, a.y, b.x));
}

static inline float dot_product(float3 a, float3 b)
{
    return fma(a.z, b.z, fma(a.y, b.y, a.x * b.x));
}

static inline float largest_component(float3 v)
{
    return max(max(fabs(v.x), fabs(v.y)), fabs(v.z));
}

// v at length 1; zero stays zero.  A power of two is taken out first (exactly), so that squares
// neither over- nor underflow for lengths between 2^-100 and 2^100.
static inline float3 unit_vector(float3 v)
{
    const float extent = largest_component(v);
    if (!(extent > 0.0f))
        return v;
    const uint exponent = as_uint(extent) & 0x7f800000u;
    const float3 scaled = v * as_float(0x7f000000u - exponent);
    return scaled * (1.0f / sqrt(dot_product(scaled, scaled)));
}

static inline float3 load3(global const float *components)
{
    return (float3)(components[0], components[1], components[2]);
}

// base^exponent by squaring: bit-reproducible, and a twentieth of the cost of pow.  base lies in
// [0, 1]; powers below 2^-100 become zero, which devices that flush denormals agree on.
static inline float integer_power(float base, uint exponent)
{
    float result = 1.0f;
    for (; exponent != 0; exponent >>= 1) {
        if (exponent & 1)
            result = result * base < 0x1p-100f ? 0.0f : result * base;
        base = base * base < 0x1p-100f ? 0.0f : base * base;
    }
    return result;
}

// log(1 + x) for x in (-1, 0], through 2 atanh(x / (2 + x)), whose series is short for the
// remainder that a power of two leaves.
static inline float log_one_plus(float x)
{
    float power = 0.0f;
    if (x < -0.25f) {
        const uint bits = as_uint(1.0f + x) + (0x3f800000u - 0x3f400000u);
        const uint exponent = bits & 0x7f800000u;
        power = (float)(int)(exponent >> 23) - 127.0f;
        x = as_float(as_uint(1.0f + x) + 0x3f800000u - exponent) - 1.0f;
    }
    const float z = x / (2.0f + x);
    const float s = z * z;
    float series = fma(s, 2.0f / 13, 2.0f / 11);
    series = fma(series, s, 2.0f / 9);
    series = fma(series, s, 2.0f / 7);
    series = fma(series, s, 2.0f / 5);
    series = fma(series, s, 2.0f / 3);
    const float logarithm = fma(z * s, series, 2.0f * z);
    return fma(power, 0x1.62e430p-1f, fma(power, -0x1.05c610p-29f, logarithm));
}

// exp(x) for x <= 0; below 2^-100 zero, as above.
static inline float exponential(float x)
{
    if (!(x > -69.0f))
        return 0.0f;
    const float power = rint(x * 0x1.715476p+0f);
    const float r = fma(power, 0x1.05c610p-29f, fma(power, -0x1.62e430p-1f, x));
    float series = fma(r, 1.0f / 5040, 1.0f / 720);
    series = fma(series, r, 1.0f / 120);
    series = fma(series, r, 1.0f / 24);
    series = fma(series, r, 1.0f / 6);
    series = fma(series, r, 0.5f);
    series = fma(series, r, 1.0f);
    series = fma(series, r, 1.0f);
    return series * as_float((uint)(127 + (int)power) << 23);
}

#endif
