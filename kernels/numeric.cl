// SPDX-License-Identifier: MIT
// Arithmetic the tracer's decisions rest on.  Contraction is off, every wanted fma is written, and
// nothing but + - * / sqrt fma, comparisons and integers takes part in a picture, so that its bits
// are the same on every device that rounds these correctly.
#ifndef CLRT_NUMERIC_CL
#define CLRT_NUMERIC_CL
#include "types.cl"

static inline Real3 real3_of(Real x, Real y, Real z)
{
    return (Real3){x, y, z};
}

// The same three components in every lane.
static inline Real3 load3(global const float *components)
{
    return real3_of(components[0], components[1], components[2]);
}

static inline Real3 sum3(Real3 a, Real3 b)
{
    return real3_of(a.x + b.x, a.y + b.y, a.z + b.z);
}

static inline Real3 scaled3(Real factor, Real3 v)
{
    return real3_of(factor * v.x, factor * v.y, factor * v.z);
}

static inline Real3 negative3(Real3 v)
{
    return real3_of(-v.x, -v.y, -v.z);
}

static inline Real3 choose3(Truth first, Real3 a, Real3 b)
{
    return real3_of(first ? a.x : b.x, first ? a.y : b.y, first ? a.z : b.z);
}

static inline bool any_lane(Truth truth)
{
    return lane_bits(truth) != 0;
}

// v at length 1; zero stays zero.  A power of two is taken out first (exactly), so that squares
// neither over- nor underflow for lengths between 2^-100 and 2^100.
static inline Real3 unit_vector(Real3 v)
{
    const Real extent = largest_component(v);
    const Count exponent = as_count(extent) & 0x7f800000u;
    const Real3 scaled = scaled3(as_real(0x7f000000u - exponent), v);
    const Real3 unit = scaled3(1.0f / sqrt(dot_product(scaled, scaled)), scaled);
    return choose3(extent > 0.0f, unit, v);
}

static inline Real unless_tiny(Real power)
{
    return power < 0x1p-100f ? 0.0f : power;
}

// base^exponent by squaring: bit-reproducible, and a twentieth of the cost of pow.  base lies in
// [0, 1]; powers below 2^-100 become zero, which devices that flush denormals agree on.
static inline Real integer_power(Real base, Count exponent)
{
    Real result = 1.0f;
    while (any_lane(exponent != 0)) {
        result = (exponent & 1) != 0 ? unless_tiny(result * base) : result;
        base = unless_tiny(base * base);
        exponent >>= 1;
    }
    return result;
}

// log(1 + x) for x in (-1, 0], through 2 atanh(x / (2 + x)), whose series is short for the
// remainder that a power of two leaves.
static inline Real log_one_plus(Real x)
{
    const Truth is_far = x < -0.25f;
    const Count bits = as_count(1.0f + x) + (0x3f800000u - 0x3f400000u);
    const Count exponent = bits & 0x7f800000u;
    const Real power = is_far ? to_real(to_int(exponent >> 23)) - 127.0f : 0.0f;
    x = is_far ? as_real(as_count(1.0f + x) + 0x3f800000u - exponent) - 1.0f : x;
    const Real z = x / (2.0f + x);
    const Real s = z * z;
    Real series = fma(s, (Real)(2.0f / 13), (Real)(2.0f / 11));
    series = fma(series, s, (Real)(2.0f / 9));
    series = fma(series, s, (Real)(2.0f / 7));
    series = fma(series, s, (Real)(2.0f / 5));
    series = fma(series, s, (Real)(2.0f / 3));
    const Real logarithm = fma(z * s, series, 2.0f * z);
    return fma(power, (Real)(0x1.62e430p-1f), fma(power, (Real)(-0x1.05c610p-29f), logarithm));
}

// exp(x) for x <= 0; below 2^-100 zero, as above.
static inline Real exponential(Real x)
{
    const Truth is_tiny = !(x > -69.0f);
    x = is_tiny ? 0.0f : x;
    const Real power = rint(x * 0x1.715476p+0f);
    const Real r = fma(power, (Real)(0x1.05c610p-29f), fma(power, (Real)(-0x1.62e430p-1f), x));
    Real series = fma(r, (Real)(1.0f / 5040), (Real)(1.0f / 720));
    series = fma(series, r, (Real)(1.0f / 120));
    series = fma(series, r, (Real)(1.0f / 24));
    series = fma(series, r, (Real)(1.0f / 6));
    series = fma(series, r, (Real)(0.5f));
    series = fma(series, r, (Real)(1.0f));
    series = fma(series, r, (Real)(1.0f));
    return is_tiny ? 0.0f : series * as_real(to_count(127 + to_int(power)) << 23);
}

#endif
