// SPDX-License-Identifier: MIT
// The traversal stack of the wide tree. The children that a ray hits are pushed in the order of
// their entry distances, the farthest first.
//
// Processors cannot predict which children a ray hits, or in which order, so sorting with branches
// would be slow. A sorting network has no branches (Batcher, "Sorting networks and their
// applications", 1968). Compared with insertion sort, it saves 17 % of a picture's time with a
// million triangles, 10 % with 122 thousand, and 1 % with 6 thousand.
#ifndef CLRT_WIDE_STACK_CL
#define CLRT_WIDE_STACK_CL
#include "ray.cl"

#if CLRT_WIDE_NODES

// Each level of the tree leaves at most WIDE - 1 children on the stack, and each push writes WIDE
// entries, even if fewer children are hit.
#define WIDE_STACK_SIZE (BVH_MAX_DEPTH * (WIDE - 1) + 2 * WIDE)

// The children of a node are adjacent, the nearest on top.
typedef struct {
    uint order[WIDE_STACK_SIZE]; // results of entry_order
    uint child[WIDE_STACK_SIZE];
    uint count;
} WideStack;

static inline uint lowest_bit(uint bits)
{
#if defined(__x86_64__) && __has_builtin(__builtin_ctz)
    return (uint)__builtin_ctz(bits);
#else
    return popcount((bits & -bits) - 1);
#endif
}

// Returns an integer for each child. A child with a smaller entry distance has a larger integer,
// and children that are not hit have the smallest ones. The bits of nonnegative floats sort like
// the floats. The child's index replaces the lowest three bits. This shortens the distance by less
// than 2^-20 of its value.
static inline uint8 entry_order(float8 entry, int8 met)
{
    const uint8 place = (uint8)(0, 1, 2, 3, 4, 5, 6, 7);
    return ~((as_uint8(entry) & 0x7ffffff8u) | place) | ~as_uint8(met);
}

// The steps of the network. exchanged_N compares each element i with element i XOR N, and moves the
// smaller value to the lower index.
static inline uint8 exchanged_1(uint8 v)
{
    const uint8 low = min(v, v.s10325476), high = max(v, v.s10325476);
    return (uint8)(low.s0, high.s1, low.s2, high.s3, low.s4, high.s5, low.s6, high.s7);
}

static inline uint8 exchanged_2(uint8 v)
{
    const uint8 low = min(v, v.s23016745), high = max(v, v.s23016745);
    return (uint8)(low.s0, low.s1, high.s2, high.s3, low.s4, low.s5, high.s6, high.s7);
}

static inline uint8 exchanged_3(uint8 v)
{
    const uint8 low = min(v, v.s32107654), high = max(v, v.s32107654);
    return (uint8)(low.s0, low.s1, high.s2, high.s3, low.s4, low.s5, high.s6, high.s7);
}

static inline uint8 exchanged_7(uint8 v)
{
    const uint8 low = min(v, v.s76543210), high = max(v, v.s76543210);
    return (uint8)(low.s0, low.s1, low.s2, low.s3, high.s4, high.s5, high.s6, high.s7);
}

static inline uint8 sorted_eight(uint8 v)
{
    v = exchanged_1(exchanged_3(exchanged_1(v)));
    return exchanged_1(exchanged_2(exchanged_7(v)));
}

#if defined(__AVX2__) && __has_builtin(__builtin_ia32_permvarsi256)
static inline uint8 permuted(uint8 v, uint8 places)
{
    typedef int Register __attribute__((vector_size(32)));
    return as_uint8(__builtin_ia32_permvarsi256((Register)as_int8(v), (Register)as_int8(places)));
}
#else
static inline uint8 permuted(uint8 v, uint8 places)
{
    const uint *from = (const uint *)&v;
    return (uint8)(from[places.s0], from[places.s1], from[places.s2], from[places.s3],
                   from[places.s4], from[places.s5], from[places.s6], from[places.s7]);
}
#endif

#if defined(__AVX512VL__) && __has_builtin(__builtin_ia32_compresssi256_mask)
static inline uint4 sorted_four(uint4 v)
{
    uint4 low = min(v, v.s1032), high = max(v, v.s1032);
    v = (uint4)(low.s0, high.s1, low.s2, high.s3);
    low = min(v, v.s3210), high = max(v, v.s3210);
    v = (uint4)(low.s01, high.s23);
    low = min(v, v.s1032), high = max(v, v.s1032);
    return (uint4)(low.s0, high.s1, low.s2, high.s3);
}

// Sorts the children that are hit. These children first move to the front, so that half a network
// can sort up to four of them. Only one of twenty nodes has more than four children that the ray
// hits.
static inline uint8 orders_sorted(uint8 order, uint met)
{
    typedef int Register __attribute__((vector_size(32)));
    const uint8 v = as_uint8(__builtin_ia32_compresssi256_mask(
        (Register)as_int8(order), (Register)as_int8((uint8)(~0u)), (uchar)met));
    if (popcount(met) > 4)
        return sorted_eight(v);
    return (uint8)(sorted_four(v.lo), v.hi);
}
#else
static inline uint8 orders_sorted(uint8 order, uint met)
{
    (void)met;
    return sorted_eight(order);
}
#endif

// Pushes the children that are hit, with their entry distances.
static inline void push_children(WideStack *stack, float8 entry, int8 met, uint8 children)
{
    const uint bits = lane_bits(met);
    const uint8 order = orders_sorted(entry_order(entry, met), bits);
    vstore8(order, 0, stack->order + stack->count);
    vstore8(permuted(children, ~order & (WIDE - 1)), 0, stack->child + stack->count);
    stack->count += popcount(bits);
}

// Pops children until the ray enters one before `reach`, which must not be negative. Returns false
// if the stack has no such child.
static inline bool pop_child(WideStack *stack, float reach, uint *child)
{
    while (stack->count > 0) {
        const uint top = --stack->count;
        *child = stack->child[top];
        if ((~stack->order[top] & ~(WIDE - 1u)) <= as_uint(reach))
            return true;
    }
    return false;
}

#endif
#endif
