// SPDX-License-Identifier: MIT
// The tracer's number types: Real, Mask and UInt. With pair nodes, they are a Scalar, an int and a
// uint. A work-item then traces one ray, and every function is scalar code. With wide nodes, they
// are vectors with one ray per lane. Comparisons then return -1 or 0 in each lane, and && || ! and
// ?: work lane by lane.
//
// Invariant: scalars and vectors are compiled from the same source, so they compute the same bits.
//
// For vectors, && || and ?: evaluate both sides in all lanes. Every lane therefore needs valid
// indices on both sides, and neither side may have side effects. A scalar branch on any_lane()
// skips work that no lane needs.
#ifndef CLRT_LANES_CL
#define CLRT_LANES_CL
#include "config.h"
#include "shared.h"

#pragma OPENCL FP_CONTRACT OFF

// Clang warns that vectors wider than the processor's registers are passed in memory. All callers
// are compiled with the program, so the calling convention does not matter. NVIDIA's compiler is an
// older clang without this warning.
#ifdef __has_warning
#if __has_warning("-Wpsabi")
#pragma clang diagnostic ignored "-Wpsabi"
#endif
#endif

// Scalar is float, or double with --precision fp64. Both precisions use the same source and the
// same scene, which is stored in floats. The pictures of both precisions therefore differ only by
// the error of float arithmetic.
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

// Pair nodes use one lane. With wide nodes, the number of lanes is set by the host, or is the
// number of floats in the target's registers.
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

// Files that are included for several types (*.inc.cl) overload functions by their arguments.
// Overloading needs an attribute of clang. With pair nodes, each file is included only once, so
// nothing is overloaded.
#if CLRT_WIDE_NODES
#define OVERLOAD __attribute__((overloadable))
#else
#define OVERLOAD
#endif

// These attributes control inlining. With the compiler's own decisions, pictures take up to a sixth
// longer on CPUs. On GPUs, a call that passes a path's state by pointer would move the state from
// registers into memory. Tests also compile GPU kernels for CPUs. Inlining everything would make
// this take six times as long.
#if CLRT_GPU && !CLRT_WIDE_NODES && !defined(__x86_64__) && !defined(__aarch64__)
#undef inline // NVIDIA's compiler and PoCL define it
#define inline inline __attribute__((always_inline))
#define ALWAYS_INLINE inline
#define NOT_INLINE    inline
#else
#define ALWAYS_INLINE inline __attribute__((always_inline))
#define NOT_INLINE    __attribute__((noinline))
#endif

#define JOINED(a, b)    a##b
#define JOIN(a, b)      JOINED(a, b)
#define FOR_LANES(name) JOIN(name, CLRT_LANES)

#if CLRT_LANES == 1
typedef Scalar Real;
typedef int Mask;
typedef uint UInt;
typedef ulong ULong;
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
typedef FOR_LANES(int) Mask;
typedef FOR_LANES(uint) UInt;
typedef FOR_LANES(ulong) ULong;
typedef UInt Bits;
#define as_bits FOR_LANES(as_uint)
#define as_real FOR_LANES(as_float)
#define to_real FOR_LANES(convert_float)
#define to_int  FOR_LANES(convert_int)
#define to_bits FOR_LANES(convert_uint)
#define to_long FOR_LANES(convert_ulong)
#endif

// Returns a word in which bit i is set if lane i is true. x86 has an instruction for this. Without
// the instruction, a whole picture takes a fifth longer. The fallback masks each lane with its bit
// and combines the lanes by a tree of ORs.
static inline uint OVERLOAD lane_bits(int mask)
{
    return mask != 0;
}

#if CLRT_WIDE_NODES
static inline uint OVERLOAD lane_bits(int4 mask)
{
#if defined(__SSE2__) && __has_builtin(__builtin_ia32_movmskps)
    typedef float Register __attribute__((vector_size(16)));
    return (uint)__builtin_ia32_movmskps((Register)as_float4(mask));
#else
    const int4 bits = mask & (int4)(1, 2, 4, 8);
    const int2 halves = bits.lo | bits.hi;
    return (uint)(halves.x | halves.y);
#endif
}

static inline uint OVERLOAD lane_bits(int8 mask)
{
#if defined(__AVX__) && __has_builtin(__builtin_ia32_movmskps256)
    typedef float Register __attribute__((vector_size(32)));
    return (uint)__builtin_ia32_movmskps256((Register)as_float8(mask));
#else
    return lane_bits(mask.lo) | lane_bits(mask.hi) << 4;
#endif
}

static inline uint OVERLOAD lane_bits(int16 mask)
{
#if defined(__AVX512DQ__) && __has_builtin(__builtin_ia32_cvtd2mask512)
    typedef int Register __attribute__((vector_size(64)));
    return (uint)__builtin_ia32_cvtd2mask512((Register)mask);
#else
    return lane_bits(mask.lo) | lane_bits(mask.hi) << 8;
#endif
}
#endif

static inline bool any_lane(Mask mask)
{
    return lane_bits(mask) != 0;
}

static inline uint lane_count(Mask mask)
{
    return popcount(lane_bits(mask));
}

// The number of packets that a work-item traces in lock step, as a beam. With 8 or 16 lanes, a beam
// has 64 rays. With 4 lanes, a beam has 16 rays, because pictures would take 1.7 times as long with
// 64.
#if CLRT_PACKET
#define PACKETS (CLRT_LANES == 8 ? 8 : 4)
#else
#define PACKETS 1
#endif

#if CLRT_LANES == 1
#define ALL_LANES 1u
static inline Mask lanes_of(uint bits)
{
    return (int)bits;
}

static inline UInt gather(global const uint *words, UInt place)
{
    return words[place];
}

// Converts the bits of a float in the scene's arrays to a Real.
static inline Real stored_real(UInt word)
{
    return as_float(word);
}

// Returns the value of the first lane in `among`, and any lane's value if `among` is empty.
static inline UInt first_lane(UInt value, Mask among)
{
    (void)among;
    return value;
}

static inline Real first_real(Real value, Mask among)
{
    (void)among;
    return value;
}
#else
#define ALL_LANES ((1u << CLRT_LANES) - 1)
static inline Mask lanes_of(uint bits)
{
#if CLRT_LANES == 4
    const UInt lane = (uint4)(1, 2, 4, 8);
#elif CLRT_LANES == 8
    const UInt lane = (uint8)(1, 2, 4, 8, 16, 32, 64, 128);
#else
    const UInt lane =
        (uint16)(1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096, 8192, 16384, 32768);
#endif
    return ((UInt)(bits)&lane) != 0;
}

#define GATHER_4(p)  words[p.s0], words[p.s1], words[p.s2], words[p.s3]
#define GATHER_8(p)  GATHER_4(p.lo), GATHER_4(p.hi)
#define GATHER_16(p) GATHER_8(p.lo), GATHER_8(p.hi)

// Returns words[place], lane by lane. AVX-512's gather instruction makes pictures 3 to 5 % faster.
static inline UInt gather(global const uint *words, UInt place)
{
#if CLRT_LANES == 16 && defined(__AVX512F__) && __has_builtin(__builtin_ia32_gathersiv16si)
    // The instruction's indices are signed, so `index` is `place` - 2^31, and counts from `words` +
    // 2^31.
    typedef int Register __attribute__((vector_size(64)));
    const Register index = (Register)as_int16(place ^ 0x80000000u);
    const ulong middle = (ulong)words + 0x80000000ul * sizeof(uint);
    return as_uint16(
        __builtin_ia32_gathersiv16si(index, (const void *)middle, index, (ushort)ALL_LANES, 4));
#else
    return (UInt)(FOR_LANES(GATHER_)(place));
#endif
}

static inline Real stored_real(UInt word)
{
    return as_real(word);
}

static inline float lane_real(const Real *lanes, uint lane)
{
    return ((const float *)lanes)[lane];
}

static inline uint lane_uint(const UInt *lanes, uint lane)
{
    return ((const uint *)lanes)[lane];
}

static inline UInt first_lane(UInt value, Mask among)
{
    const uint bits = lane_bits(among);
    return (UInt)(((uint *)&value)[bits == 0 ? 0 : popcount((bits & -bits) - 1)]);
}

static inline Real first_real(Real value, Mask among)
{
    return as_real(first_lane(as_bits(value), among));
}
#endif

#endif
