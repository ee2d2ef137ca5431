// SPDX-License-Identifier: MIT
// The midpoint split of the course that docs/scenes.md names: a plane through the middle of the
// box, across its longest axis. If a side is empty, or a child is hardly shorter than its parent
// along this axis, the next axis is tried.
#include "accel/build.h"

#define LEAF_TRIANGLES 4
#define LARGEST_CHILD  0.9f // limit of a child's extent along the axis, divided by its parent's

// Returns the most levels: 10 more than a balanced tree with four triangles per leaf has.
static uint32_t deepest_level(uint32_t triangle_count)
{
    const uint32_t leaves = (uint32_t)(triangle_count / 4.0 + 0.5);
    uint32_t levels = 0;
    while (leaves > 1u << levels && levels < 31)
        levels++;
    return 10 + 1 + levels;
}

static void axes_by_extent(const Bounds *box, int axes[3])
{
    for (int axis = 0; axis < 3; axis++)
        axes[axis] = axis;
    for (int pass = 0; pass < 2; pass++)
        for (int i = 0; i < 2; i++)
            if (bounds_extent(box, axes[i]) < bounds_extent(box, axes[i + 1])) {
                const int longer = axes[i + 1];
                axes[i + 1] = axes[i];
                axes[i] = longer;
            }
}

static bool makes_progress(const BuildRange *range, Split *split)
{
    const float largest = LARGEST_CHILD * bounds_extent(&range->box, split->axis);
    Bounds sides[2] = {bounds_empty(), bounds_empty()};
    uint32_t counts[2] = {0};
    for (uint32_t i = 0; i < range->count; i++) {
        const bool left = split_is_left(split, &range->items[i]);
        bounds_unite(&sides[left], &range->items[i].bounds);
        counts[left]++;
    }
    split->left = counts[1];
    return counts[0] > 0 && counts[1] > 0 && bounds_extent(&sides[0], split->axis) <= largest &&
           bounds_extent(&sides[1], split->axis) <= largest;
}

Split split_midpoint(const BuildRange *range)
{
    if (range->count <= LEAF_TRIANGLES || range->depth >= deepest_level(range->total))
        return (Split){.kind = SPLIT_NONE};
    int axes[3];
    axes_by_extent(&range->box, axes);
    for (int i = 0; i < 3; i++) {
        const float doubled_middle = range->box.low[axes[i]] - range->box.negated_high[axes[i]];
        Split split = {SPLIT_PLANE, axes[i], 0, 1, nextafterf(doubled_middle, INFINITY), 0};
        if (makes_progress(range, &split))
            return split;
    }
    return (Split){.kind = SPLIT_NONE};
}
