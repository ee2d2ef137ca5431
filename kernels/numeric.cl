// SPDX-License-Identifier: MIT
// The arithmetic of the tracer: vectors, powers, logarithms and exponentials. OpenCL's own powers,
// logarithms and exponentials may differ in their last bits between devices.
//
// Invariant: contraction is off, and every fma is explicit. A picture depends only on + - * / sqrt
// fma rint floor, signs (fabs, copysign), conversions, comparisons and integers. Every device that
// rounds these correctly computes the same bits.
#ifndef CLRT_NUMERIC_CL
#define CLRT_NUMERIC_CL
#include "lanes.cl"

// This inclusion defines the triangle test for Real. The second inclusion defines it for one ray
// against the eight triangles of a block. Both compile the same files, so their results are equal.
#include "triangle.inc.cl"

// The types named Wide... have a lane for each of the WIDE triangles of a block.
#if CLRT_WIDE_NODES && CLRT_LANES == WIDE
typedef Real3 Wide3;
typedef Shear WideShear;
typedef Corners WideCorners;
typedef Edges WideEdges;
typedef SurfaceRay WideSurfaceRay;
typedef TriangleTest WideTriangleTest;
typedef Meeting WideMeeting;
#elif CLRT_WIDE_NODES
#define Real         float8
#define Mask         int8
#define UInt         uint8
#define Real3        Wide3
#define Shear        WideShear
#define Corners      WideCorners
#define Edges        WideEdges
#define SurfaceRay   WideSurfaceRay
#define TriangleTest WideTriangleTest
#define Meeting      WideMeeting
#include "triangle.inc.cl"
#undef Real
#undef Mask
#undef UInt
#undef Real3
#undef Shear
#undef Corners
#undef Edges
#undef SurfaceRay
#undef TriangleTest
#undef Meeting
#endif

static inline Real3 real3_of(Real x, Real y, Real z)
{
    return (Real3){x, y, z};
}

// Returns *v, read component by component. PoCL would copy a whole struct in pieces smaller than a
// register. A load of a whole register soon afterwards would wait for all these pieces.
static inline Real3 read3(const Real3 *v)
{
    return real3_of(v->x, v->y, v->z);
}

// Loads the same three components into every lane.
static inline Real3 load3(global const float *components)
{
    return real3_of(components[0], components[1], components[2]);
}

static inline Real3 load_private3(const float *components)
{
    return real3_of(components[0], components[1], components[2]);
}

static inline Real3 sum3(Real3 a, Real3 b)
{
    return real3_of(a.x + b.x, a.y + b.y, a.z + b.z);
}

static inline Real3 product3(Real3 a, Real3 b)
{
    return real3_of(a.x * b.x, a.y * b.y, a.z * b.z);
}

static inline Real3 scaled3(Real factor, Real3 v)
{
    return real3_of(factor * v.x, factor * v.y, factor * v.z);
}

static inline Real3 negative3(Real3 v)
{
    return real3_of(-v.x, -v.y, -v.z);
}

static inline Real3 choose3(Mask first, Real3 a, Real3 b)
{
    return real3_of(first ? a.x : b.x, first ? a.y : b.y, first ? a.z : b.z);
}

// Returns 1 for negative numbers and -0, else 0. This takes fewer instructions than v < 0.
static inline UInt sign_bit(Real v)
{
    return (UInt)(as_bits(v) >> (int)(8 * sizeof(Scalar) - 1));
}

static inline Real clamp_to_one(Real v)
{
    return clamp(v, (Real)(0.0f), (Real)(1.0f));
}

// Returns `v` scaled to length 1, or zero if `v` is zero. First divides `v` by a power of two,
// which is exact. The sum of squares then neither overflows nor underflows for lengths from 2^-100
// to 2^100.
static inline Real3 unit_vector(Real3 v)
{
    const Real extent = largest_component(v);
    const Bits exponent = as_bits(extent) & EXPONENT_MASK;
    const Real3 scaled = scaled3(as_real(2 * BITS_OF_ONE - exponent), v);
    const Real3 unit = scaled3(1.0f / sqrt(dot_product(scaled, scaled)), scaled);
    return choose3(extent > 0.0f, unit, v);
}

static inline Real unless_tiny(Real power)
{
    return power < 0x1p-100f ? 0.0f : power;
}

// Returns base^exponent for a base in [0, 1]. Repeated squaring gives the same bits on every
// device, in a twentieth of the time of pow. Powers below 2^-100 become zero, so devices that flush
// denormals compute the same bits, too.
static inline Real integer_power(Real base, UInt exponent)
{
    Real result = 1.0f;
    while (any_lane(exponent != 0)) {
        result = (exponent & 1) != 0 ? unless_tiny(result * base) : result;
        base = unless_tiny(base * base);
        exponent >>= 1;
    }
    return result;
}

// The quotient of two literals, rounded once to a Real.
#define RATIO(a, b) ((Real)(a) / (Real)(b))

// Returns (2 atanh(z) - 2 z) / z^3 for s = z^2 up to 0.04.
static inline Real log_series(Real s)
{
    Real series = RATIO(2.0f, 13.0f);
    if (CLRT_FP64) { // float needs only the terms up to 2/13
        series = fma(RATIO(2.0f, 21.0f), s, RATIO(2.0f, 19.0f));
        series = fma(series, s, RATIO(2.0f, 17.0f));
        series = fma(series, s, RATIO(2.0f, 15.0f));
        series = fma(series, s, RATIO(2.0f, 13.0f));
    }
    series = fma(series, s, RATIO(2.0f, 11.0f));
    series = fma(series, s, RATIO(2.0f, 9.0f));
    series = fma(series, s, RATIO(2.0f, 7.0f));
    series = fma(series, s, RATIO(2.0f, 5.0f));
    return fma(series, s, RATIO(2.0f, 3.0f));
}

// Returns log(1 + x) = 2 atanh(x / (2 + x)) for x in (-1, 0]. If x is below -1/4, 1 + x is first
// divided by a power of two. The quotient is in [3/4, 3/2), for which a short series suffices.
static inline Real log_one_plus(Real x)
{
    const Mask is_far = x < -0.25f;
    const Bits bits = as_bits(1.0f + x) + ((Bits)(1) << (SIGNIFICAND_BITS - 1));
    const Bits exponent = bits & EXPONENT_MASK;
    const Real power =
        is_far ? to_real(to_int(exponent >> SIGNIFICAND_BITS) - EXPONENT_BIAS) : 0.0f;
    x = is_far ? as_real(as_bits(1.0f + x) + BITS_OF_ONE - exponent) - 1.0f : x;
    const Real z = x / (2.0f + x);
    const Real s = z * z;
    const Real logarithm = fma(z * s, log_series(s), 2.0f * z);
    return fma(power, (Real)(LN2_HIGH), fma(power, (Real)(LN2_LOW), logarithm));
}

// Returns exp(r) for |r| up to log(2) / 2.
static inline Real exponential_series(Real r)
{
    Real series = RATIO(1.0f, 5040.0f);
    if (CLRT_FP64) { // float needs only the terms up to r^7
        series = fma(RATIO(1.0f, 6227020800.0f), r, RATIO(1.0f, 479001600.0f));
        series = fma(series, r, RATIO(1.0f, 39916800.0f));
        series = fma(series, r, RATIO(1.0f, 3628800.0f));
        series = fma(series, r, RATIO(1.0f, 362880.0f));
        series = fma(series, r, RATIO(1.0f, 40320.0f));
        series = fma(series, r, RATIO(1.0f, 5040.0f));
    }
    series = fma(series, r, RATIO(1.0f, 720.0f));
    series = fma(series, r, RATIO(1.0f, 120.0f));
    series = fma(series, r, RATIO(1.0f, 24.0f));
    series = fma(series, r, RATIO(1.0f, 6.0f));
    series = fma(series, r, (Real)(0.5f));
    series = fma(series, r, (Real)(1.0f));
    return fma(series, r, (Real)(1.0f));
}

// Returns exp(x) for x <= 0. Results up to exp(-69), about 2^-100, are zero, as in integer_power.
static inline Real exponential(Real x)
{
    const Mask is_tiny = !(x > -69.0f);
    x = is_tiny ? 0.0f : x;
    const Real power = rint(x * INVERSE_LN2);
    const Real r = fma(power, (Real)(-LN2_LOW), fma(power, (Real)(-LN2_HIGH), x));
    const Real scale = as_real(to_bits(EXPONENT_BIAS + to_int(power)) << SIGNIFICAND_BITS);
    return is_tiny ? 0.0f : exponential_series(r) * scale;
}

#endif
