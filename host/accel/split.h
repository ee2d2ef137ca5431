// SPDX-License-Identifier: MIT
// How a builder divides the triangles of a node: one function for each builder.
#pragma once

#include "accel/box.h"

// A triangle as builders move it about: its box and number, 32 bytes.
typedef struct {
    float low[3];
    uint32_t triangle;
    float high[3];
    uint32_t padding; // keeps two of them in a cache line
} BuildItem;

typedef struct {
    BuildItem *items; // the node's own; reordered by a split
    uint32_t count;
    Box box;        // around the items
    uint32_t depth; // of the node; the root's is 1
    uint32_t total; // items in the whole tree
} BuildRange;

// Each reorders range->items and returns how many of them go to the left child, or 0 where the
// node had better stay a leaf.  Both are deterministic and keep no state.
uint32_t split_midpoint(const BuildRange *range);
uint32_t split_sah(const BuildRange *range);

// The center of an item on an axis, doubled.
static inline float item_center(const BuildItem *item, int axis)
{
    return item->low[axis] + item->high[axis];
}
