// SPDX-License-Identifier: MIT
// What the tracer computes with: Real, Truth and Count.  In the ray family they are a Scalar, an
// int and a uint, one ray a work-item, and every function reads as plain scalar code.  In the
// packet family they are vectors with a ray in each lane: comparisons give -1 or 0 lane by lane, &&
// || ! and ?: choose lane by lane, and one text serves both, so that both compute the same bits.
#ifndef CLRT_LANES_CL
#define CLRT_LANES_CL
#include "precision.h"
#include "shared.h"

#pragma OPENCL FP_CONTRACT OFF

// As many lanes as the target's registers hold; drivers report the same native width for all.
#if !CLRT_WIDE_NODES
#undef CLRT_LANES
#define CLRT_LANES 1
#elif !defined(CLRT_LANES)
#if defined(__AVX512F__)
#define CLRT_LANES 16
#elif defined(__AVX__)
#define CLRT_LANES 8
#else
#define CLRT_LANES 4
#endif
#endif

// Where texts are compiled for more than one type (vector.cl), functions are told apart by their
// arguments, which takes clang's attribute; the plain ray family does without.
#if CLRT_WIDE_NODES
#define OVERLOAD __attribute__((overloadable))
#else
#define OVERLOAD
#endif

// The compiler's own judgment of what to inline costs up to a sixth of the speed here.
#define NOT_INLINE    __attribute__((noinline))
#define ALWAYS_INLINE inline __attribute__((always_inline))

#define JOINED(a, b)    a##b
#define JOIN(a, b)      JOINED(a, b)
#define FOR_LANES(name) JOIN(name, CLRT_LANES)

#if CLRT_LANES == 1
typedef Scalar Real;
typedef int Truth;
typedef uint Count;
typedef ulong LongCount;
#if CLRT_FP64
typedef ulong Bits;
typedef double2 Real2;
#define as_bits as_ulong
#define as_real as_double
#define to_real convert_double
#define to_bits convert_ulong
#else
typedef uint Bits;
typedef float2 Real2;
#define as_bits as_uint
#define as_real as_float
#define to_real convert_float
#define to_bits convert_uint
#endif
#define to_int  convert_int
#define to_long convert_ulong
#else
typedef FOR_LANES(float) Real;
typedef FOR_LANES(int) Truth;
typedef FOR_LANES(uint) Count;
typedef FOR_LANES(ulong) LongCount;
typedef Count Bits;
#define as_bits FOR_LANES(as_uint)
#define as_real FOR_LANES(as_float)
#define to_real FOR_LANES(convert_float)
#define to_int  FOR_LANES(convert_int)
#define to_bits FOR_LANES(convert_uint)
#define to_long FOR_LANES(convert_ulong)
#endif

// One bit for each lane that is true.  x86 has an instruction for this; without it, each lane is
// given its bit and a tree of ORs gathers them, a fifth slower over a whole picture.
static inline uint OVERLOAD lane_bits(int truth)
{
    return truth != 0;
}

#if CLRT_WIDE_NODES
static inline uint OVERLOAD lane_bits(int4 truth)
{
#if defined(__SSE2__) && __has_builtin(__builtin_ia32_movmskps)
    typedef float Register __attribute__((vector_size(16)));
    return (uint)__builtin_ia32_movmskps((Register)as_float4(truth));
#else
    const int4 bits = truth & (int4)(1, 2, 4, 8);
    const int2 halves = bits.lo | bits.hi;
    return (uint)(halves.x | halves.y);
#endif
}

static inline uint OVERLOAD lane_bits(int8 truth)
{
#if defined(__AVX__) && __has_builtin(__builtin_ia32_movmskps256)
    typedef float Register __attribute__((vector_size(32)));
    return (uint)__builtin_ia32_movmskps256((Register)as_float8(truth));
#else
    return lane_bits(truth.lo) | lane_bits(truth.hi) << 4;
#endif
}

static inline uint OVERLOAD lane_bits(int16 truth)
{
#if defined(__AVX512DQ__) && __has_builtin(__builtin_ia32_cvtd2mask512)
    typedef int Register __attribute__((vector_size(64)));
    return (uint)__builtin_ia32_cvtd2mask512((Register)truth);
#else
    return lane_bits(truth.lo) | lane_bits(truth.hi) << 8;
#endif
}
#endif

#if CLRT_LANES == 1
#define ALL_LANES 1u
static inline Truth lanes_of(uint bits)
{
    return (int)bits;
}

static inline Count gather(global const uint *words, Count place)
{
    return words[place];
}

// A float of the scene, given as a word.
static inline Real stored_real(Count word)
{
    return as_float(word);
}
#else
#define ALL_LANES ((1u << CLRT_LANES) - 1)
static inline Truth lanes_of(uint bits)
{
#if CLRT_LANES == 4
    const Count lane = (uint4)(1, 2, 4, 8);
#elif CLRT_LANES == 8
    const Count lane = (uint8)(1, 2, 4, 8, 16, 32, 64, 128);
#else
    const Count lane =
        (uint16)(1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096, 8192, 16384, 32768);
#endif
    return ((Count)(bits)&lane) != 0;
}

// words[place], lane by lane.
static inline Count gather(global const uint *words, Count place)
{
#define GATHER_4(p)  words[p.s0], words[p.s1], words[p.s2], words[p.s3]
#define GATHER_8(p)  GATHER_4(p.lo), GATHER_4(p.hi)
#define GATHER_16(p) GATHER_8(p.lo), GATHER_8(p.hi)
    return (Count)(FOR_LANES(GATHER_)(place));
}

static inline Real stored_real(Count word)
{
    return as_real(word);
}
#endif

#endif
