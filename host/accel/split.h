// SPDX-License-Identifier: MIT
// Chooses how to split a node, with one function per builder.
#pragma once

#include "accel/bounds.h"

typedef struct {
    const BuildItem *items; // items of the node
    uint32_t count;         // number of items
    uint32_t weight;        // number of triangles in all items
    Bounds box;             // bounds of the items
    Bounds centers;         // bounds of their doubled centers (bounds.h)
    uint32_t depth;         // depth of the node; 1 for the root
    uint32_t total;         // triangles in the whole tree
    BvhLeaves leaves;
} BuildRange;

typedef enum {
    SPLIT_NONE,  // the node is a leaf
    SPLIT_PLANE, // a plane separates the items' centers
    SPLIT_HALVES // each child gets half of the items
} SplitKind;

// An item is left of the plane if (doubled center - origin) * scale < limit.
typedef struct {
    SplitKind kind;
    int axis;
    float origin, scale, limit;
    uint32_t left; // triangles on the left: at least one, but not all
} Split;

// Return the split of a range. Both functions are deterministic and stateless.
Split split_midpoint(const BuildRange *range);
Split split_sah(const BuildRange *range);

static inline bool split_is_left(const Split *split, const BuildItem *item)
{
    return (item_center(item, split->axis) - split->origin) * split->scale < split->limit;
}
