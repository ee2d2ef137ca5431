// SPDX-License-Identifier: MIT
// Disjoint sets of numbers, by union-find. A number's parent is a lower number of its set, or the
// number itself if it is the lowest one of the set, which is the set's root.
#pragma once

#include "base/array.h"

#include <stdint.h>

// Returns the parents of the numbers 0 to `count` - 1, each in a set of its own. Returns NULL if
// memory runs out. The caller frees the result.
static inline uint32_t *sets_make(size_t count, Error *error)
{
    uint32_t *parents = memory_raw(count, sizeof *parents, error);
    for (uint32_t number = 0; parents != NULL && number < count; number++)
        parents[number] = number;
    return parents;
}

// Returns the root of the number's set, and shortens the path to the root.
static inline uint32_t set_root(uint32_t *parents, uint32_t number)
{
    while (parents[number] != number) {
        parents[number] = parents[parents[number]];
        number = parents[number];
    }
    return number;
}

// Joins the sets of two numbers. Returns false if they were in one set already.
static inline bool sets_join(uint32_t *parents, uint32_t one, uint32_t other)
{
    const uint32_t first = set_root(parents, one), second = set_root(parents, other);
    parents[first > second ? first : second] = first > second ? second : first;
    return first != second;
}
