// SPDX-License-Identifier: MIT
// The surface area heuristic over bins: of 3 x 15 planes, the one that makes an average ray's
// expected cost least (Wald, "On fast construction of SAH-based bounding volume hierarchies",
// 2007).  A node becomes a leaf where no plane is cheaper than testing its triangles.
#include "accel/split.h"

#include <stdlib.h>

#define BINS 16

// In triangle tests.  Reading a node and testing both its boxes costs about what one triangle
// does; leaves past the limit are divided whatever the estimate says.
#define NODE_COST          1.0f
#define LARGEST_LEAF       8
#define MEDIAN_SPLIT_DEPTH 32 // deeper, halving bounds what an unlucky distribution can cost

typedef struct {
    Box box;
    uint32_t count;
} Bin;

typedef struct {
    int axis; // -1 while none was found
    int bin;  // the first bin of the right side
    float cost;
} Plane;

typedef struct {
    float origin, scale; // bin = (doubled center - origin) * scale
} Binning;

static Binning binning_of(const Box *centers, int axis)
{
    const float extent = centers->high[axis] - centers->low[axis];
    const float scale = (float)BINS * 0.999999f / extent;
    return (Binning){centers->low[axis], extent > 0 && scale < INFINITY ? scale : 0};
}

static int bin_of(const BuildItem *item, int axis, Binning binning)
{
    return (int)((item_center(item, axis) - binning.origin) * binning.scale);
}

static Box center_bounds(const BuildRange *range)
{
    Box centers = box_empty();
    for (uint32_t i = 0; i < range->count; i++) {
        const BuildItem *item = &range->items[i];
        const float center[3] = {item_center(item, 0), item_center(item, 1), item_center(item, 2)};
        box_include_point(&centers, center);
    }
    return centers;
}

static void fill_bins(Bin bins[BINS], const BuildRange *range, int axis, Binning binning)
{
    for (int i = 0; i < BINS; i++)
        bins[i] = (Bin){box_empty(), 0};
    for (uint32_t i = 0; i < range->count; i++) {
        const BuildItem *item = &range->items[i];
        Bin *bin = &bins[bin_of(item, axis, binning)];
        box_include_point(&bin->box, item->low);
        box_include_point(&bin->box, item->high);
        bin->count++;
    }
}

// Sweeps once from the right, to know each right side, and once from the left, to price each plane.
static void price_planes(const Bin bins[BINS], int axis, Plane *best)
{
    float right_cost[BINS];
    Bin side = {box_empty(), 0};
    for (int i = BINS - 1; i > 0; i--) {
        box_include(&side.box, &bins[i].box);
        side.count += bins[i].count;
        right_cost[i] = side.count > 0 ? box_half_area(&side.box) * (float)side.count : INFINITY;
    }
    side = (Bin){box_empty(), 0};
    for (int i = 1; i < BINS; i++) {
        box_include(&side.box, &bins[i - 1].box);
        side.count += bins[i - 1].count;
        const float cost = box_half_area(&side.box) * (float)side.count + right_cost[i];
        if (side.count > 0 && cost < best->cost)
            *best = (Plane){axis, i, cost};
    }
}

static uint32_t partition(const BuildRange *range, Plane plane, Binning binning)
{
    uint32_t left = 0, right = range->count;
    while (left < right) {
        if (bin_of(&range->items[left], plane.axis, binning) < plane.bin) {
            left++;
        } else {
            right--;
            const BuildItem swapped = range->items[left];
            range->items[left] = range->items[right];
            range->items[right] = swapped;
        }
    }
    return left;
}

static int longest_axis(const Box *box)
{
    int longest = 0;
    for (int axis = 1; axis < 3; axis++)
        if (box->high[axis] - box->low[axis] > box->high[longest] - box->low[longest])
            longest = axis;
    return longest;
}

#define COMPARE_ON_AXIS(axis)                                                                      \
    static int compare_##axis(const void *first, const void *second)                               \
    {                                                                                              \
        const BuildItem *a = first, *b = second;                                                   \
        const float x = item_center(a, axis), y = item_center(b, axis);                            \
        if (x != y)                                                                                \
            return x < y ? -1 : 1;                                                                 \
        return a->triangle < b->triangle ? -1 : 1;                                                 \
    }
COMPARE_ON_AXIS(0)
COMPARE_ON_AXIS(1)
COMPARE_ON_AXIS(2)

// Halves the items by number, so that any set of triangles, equal ones included, ends in leaves.
static uint32_t split_median(const BuildRange *range, const Box *centers)
{
    static int (*const compare[3])(const void *, const void *) = {compare_0, compare_1, compare_2};
    qsort(range->items, range->count, sizeof *range->items, compare[longest_axis(centers)]);
    return range->count / 2;
}

uint32_t split_sah(const BuildRange *range)
{
    if (range->count <= LARGEST_LEAF)
        return 0;
    const Box centers = center_bounds(range);
    const float area = box_half_area(&range->box);
    Plane best = {-1, 0, INFINITY};
    if (range->depth < MEDIAN_SPLIT_DEPTH) {
        for (int axis = 0; axis < 3; axis++) {
            Bin bins[BINS];
            const Binning binning = binning_of(&centers, axis);
            if (binning.scale == 0)
                continue;
            fill_bins(bins, range, axis, binning);
            price_planes(bins, axis, &best);
        }
    }
    const bool pays = best.cost + NODE_COST * area < area * (float)range->count;
    if (best.axis >= 0 && (pays || range->count > LARGEST_LEAF))
        return partition(range, best, binning_of(&centers, best.axis));
    return range->count > LARGEST_LEAF ? split_median(range, &centers) : 0;
}
