// SPDX-License-Identifier: MIT
// Moves some lanes of a vector to the front, and back.
#ifndef CLRT_LANE_MOVES_CL
#define CLRT_LANE_MOVES_CL
#include "wide_stack.cl"

#if CLRT_WIDE_NODES

// A LaneChoice selects the lanes that compressed() moves to the front. For AVX2, it has the numbers
// of these lanes, in order. Otherwise, bit i is set if lane i is selected.
#if CLRT_LANES == 16 && defined(__AVX512F__) && __has_builtin(__builtin_ia32_compresssi512_mask)
typedef int LaneRegister __attribute__((vector_size(64)));
typedef uint LaneChoice;

static inline LaneChoice lane_choice(uint bits)
{
    return bits;
}

// Returns `v` with the chosen lanes moved to the front, in order.
static inline UInt compressed(UInt v, LaneChoice chosen)
{
    return as_uint16(__builtin_ia32_compresssi512_mask((LaneRegister)as_int16(v),
                                                       (LaneRegister)as_int16(v), (ushort)chosen));
}

// Inverts compressed(): moves the first lanes of `v` back to the lanes selected by `bits`. The
// other lanes come from `rest`.
static inline UInt expanded(UInt v, uint bits, UInt rest)
{
    return as_uint16(__builtin_ia32_expandsi512_mask((LaneRegister)as_int16(v),
                                                     (LaneRegister)as_int16(rest), (ushort)bits));
}
#elif CLRT_LANES == 8 && defined(__AVX2__)
typedef UInt LaneChoice;

// Callers call lane_choice once for all words of a packet. With a call for each word, scenes with
// mirrors would take 2 to 5 % longer, and scenes with glass 3 to 9 % longer.
static inline LaneChoice lane_choice(uint bits)
{
    ulong order = 0; // a byte for each lane
    for (uint lane = CLRT_LANES; lane-- > 0;)
        order = (bits >> lane & 1) != 0 ? order << 8 | lane : order;
    return convert_uint8(as_uchar8(order));
}

static inline UInt compressed(UInt v, LaneChoice chosen)
{
    return permuted(v, chosen);
}

static inline UInt expanded(UInt v, uint bits, UInt rest)
{
    const UInt before = (UInt)(bits) & (uint8)(0, 1, 3, 7, 15, 31, 63, 127);
    return lanes_of(bits) ? permuted(v, popcount(before)) : rest;
}
#else
typedef uint LaneChoice;

static inline LaneChoice lane_choice(uint bits)
{
    return bits;
}

static inline UInt compressed(UInt v, LaneChoice chosen)
{
    UInt front = v;
    for (uint place = 0; chosen != 0; chosen &= chosen - 1)
        ((uint *)&front)[place++] = lane_uint(&v, lowest_bit(chosen));
    return front;
}

static inline UInt expanded(UInt v, uint bits, UInt rest)
{
    for (uint place = 0; bits != 0; bits &= bits - 1)
        ((uint *)&rest)[lowest_bit(bits)] = lane_uint(&v, place++);
    return rest;
}
#endif

#endif
#endif
