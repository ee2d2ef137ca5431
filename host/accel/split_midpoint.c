// SPDX-License-Identifier: MIT
// The course's split: a plane halfway through the box, across its longest axis first.  An axis is
// refused when a side stays empty or a child is hardly smaller than its parent.
#include "accel/split.h"

#define LEAF_TRIANGLES    4
#define SMALLEST_PROGRESS 0.9f // of the parent's extent

// 10 levels more than a balanced tree of four triangles a leaf.
static uint32_t deepest_level(uint32_t triangle_count)
{
    const uint32_t leaves = (uint32_t)(triangle_count / 4.0 + 0.5);
    uint32_t levels = 0;
    while (leaves > 1u << levels && levels < 31)
        levels++;
    return 10 + 1 + levels;
}

static void axes_by_extent(const Box *box, int axes[3])
{
    float extent[3];
    for (int axis = 0; axis < 3; axis++) {
        axes[axis] = axis;
        extent[axis] = box->high[axis] - box->low[axis];
    }
    for (int pass = 0; pass < 2; pass++)
        for (int i = 0; i < 2; i++)
            if (extent[axes[i]] < extent[axes[i + 1]]) {
                const int longer = axes[i + 1];
                axes[i + 1] = axes[i];
                axes[i] = longer;
            }
}

static uint32_t partition(BuildItem *items, uint32_t count, int axis, float doubled_plane)
{
    uint32_t left = 0, right = count;
    while (left < right) {
        if (item_center(&items[left], axis) <= doubled_plane) {
            left++;
        } else {
            right--;
            const BuildItem swapped = items[left];
            items[left] = items[right];
            items[right] = swapped;
        }
    }
    return left;
}

static float extent_of(const BuildItem *items, uint32_t count, int axis)
{
    float low = INFINITY, high = -INFINITY;
    for (uint32_t i = 0; i < count; i++) {
        low = items[i].low[axis] < low ? items[i].low[axis] : low;
        high = items[i].high[axis] > high ? items[i].high[axis] : high;
    }
    return high - low;
}

uint32_t split_midpoint(const BuildRange *range)
{
    if (range->count <= LEAF_TRIANGLES || range->depth >= deepest_level(range->total))
        return 0;
    int axes[3];
    axes_by_extent(&range->box, axes);
    for (int i = 0; i < 3; i++) {
        const int axis = axes[i];
        const float largest = SMALLEST_PROGRESS * (range->box.high[axis] - range->box.low[axis]);
        const uint32_t left = partition(range->items, range->count, axis,
                                        range->box.low[axis] + range->box.high[axis]);
        if (left > 0 && left < range->count && extent_of(range->items, left, axis) <= largest &&
            extent_of(range->items + left, range->count - left, axis) <= largest)
            return left;
    }
    return 0;
}
