// SPDX-License-Identifier: MIT
// The split of a node's triangles: one function for each builder.
#pragma once

#include "accel/bounds.h"

typedef struct {
    const BuildItem *items; // of the node
    uint32_t count;         // of items
    uint32_t weight;        // of all items: triangles
    Bounds box;             // around the items
    Bounds centers;         // around their doubled centers
    uint32_t depth;         // of the node; the root's is 1
    uint32_t total;         // triangles in the whole tree
    BvhLeaves leaves;
} BuildRange;

typedef enum {
    SPLIT_NONE,  // the node is a leaf
    SPLIT_PLANE, // items left of a plane and right of it
    SPLIT_HALVES // equal numbers of items on both sides
} SplitKind;

// An item is left of the plane if (its doubled center - origin) * scale < limit.
typedef struct {
    SplitKind kind;
    int axis;
    float origin, scale, limit;
    uint32_t left; // weight of the items on the left: some, but not all
} Split;

// Both are deterministic and stateless.
Split split_midpoint(const BuildRange *range);
Split split_sah(const BuildRange *range);

static inline bool split_is_left(const Split *split, const BuildItem *item)
{
    return (item_center(item, split->axis) - split->origin) * split->scale < split->limit;
}
