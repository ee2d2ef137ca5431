// SPDX-License-Identifier: MIT
// The surface area heuristic over bins: of 3 x 15 planes, the one that makes an average ray's
// expected cost least (Wald, "On fast construction of SAH-based bounding volume hierarchies",
// 2007).  A node becomes a leaf where no plane is cheaper than testing its triangles.
#include "accel/split.h"

#include <stdlib.h>

#define BINS 16

// What a leaf of single triangles may hold.
#define LARGEST_LEAF 8

// Deeper, halving bounds what an unlucky distribution can cost.
#define MEDIAN_SPLIT_DEPTH 32

// Prices are in tests of a leaf's unit, which is one triangle or a block of them.
typedef struct {
    uint32_t unit; // triangles
    float node;    // reading a node and testing both its boxes
} Costs;

static const Costs costs_of[] = {[LEAVES_SINGLE] = {1, 1.0f}, [LEAVES_BLOCKS] = {WIDE, 0.3f}};

typedef struct {
    Bounds bounds[3][BINS];
    uint32_t weights[3][BINS];
} Bins;

// Bin = (doubled center - origin) * scale; the scale is zero on an axis without extent.
typedef struct {
    Float4 origin, scale;
} Binning;

typedef struct {
    int axis; // -1 while none was found
    int bin;  // the first bin of the right side
    uint32_t left;
    float cost;
} Plane;

static float price(const Costs *costs, const Bounds *bounds, uint32_t weight)
{
    return bounds_half_area(bounds) * (float)((weight + costs->unit - 1) / costs->unit);
}

static Binning binning_of(const Bounds *centers)
{
    Binning binning = {centers->low, {0}};
    for (int axis = 0; axis < 3; axis++) {
        const float extent = bounds_extent(centers, axis);
        const float scale = (float)BINS * 0.999999f / extent;
        binning.scale[axis] = extent > 0 && scale < INFINITY ? scale : 0;
    }
    binning.origin[3] = 1; // far from the item numbers there, which are denormal numbers
    return binning;
}

static void clear_bins(Bins *bins)
{
    for (int axis = 0; axis < 3; axis++)
        for (int bin = 0; bin < BINS; bin++) {
            bins->bounds[axis][bin] = bounds_empty();
            bins->weights[axis][bin] = 0;
        }
}

static void fill_bins(Bins *bins, const BuildRange *range, const Binning *binning)
{
    for (uint32_t i = 0; i < range->count; i++) {
        const Bounds bounds = range->items[i].bounds;
        const Float4 place = (bounds.low - bounds.negated_high - binning->origin) * binning->scale;
        for (int axis = 0; axis < 3; axis++) {
            const int bin = (int)place[axis];
            bounds_unite(&bins->bounds[axis][bin], &bounds);
            bins->weights[axis][bin] += range->items[i].weight;
        }
    }
}

// Sweeps once from the right, to know each right side, and once from the left, to price each plane.
static void price_planes(const Bins *bins, int axis, const Costs *costs, Plane *best)
{
    float right_cost[BINS];
    Bounds side = bounds_empty();
    uint32_t weight = 0;
    for (int i = BINS - 1; i > 0; i--) {
        bounds_unite(&side, &bins->bounds[axis][i]);
        weight += bins->weights[axis][i];
        right_cost[i] = price(costs, &side, weight);
    }
    side = bounds_empty();
    weight = 0;
    // Prices of empty sides are no numbers and never less than the best.
    for (int i = 1; i < BINS; i++) {
        bounds_unite(&side, &bins->bounds[axis][i - 1]);
        weight += bins->weights[axis][i - 1];
        const float cost = price(costs, &side, weight) + right_cost[i];
        if (cost < best->cost)
            *best = (Plane){axis, i, weight, cost};
    }
}

static Plane cheapest_plane(const BuildRange *range, const Binning *binning, const Costs *costs)
{
    Bins bins;
    Plane best = {-1, 0, 0, INFINITY};
    clear_bins(&bins);
    fill_bins(&bins, range, binning);
    for (int axis = 0; axis < 3; axis++)
        if (binning->scale[axis] > 0)
            price_planes(&bins, axis, costs, &best);
    return best;
}

Split split_sah(const BuildRange *range)
{
    const Costs *costs = &costs_of[range->leaves];
    // A block is tested at once, however full.
    if (range->weight <= costs->unit)
        return (Split){.kind = SPLIT_NONE};
    Plane best = {-1, 0, 0, INFINITY};
    const Binning binning = binning_of(&range->centers);
    if (range->depth < MEDIAN_SPLIT_DEPTH)
        best = cheapest_plane(range, &binning, costs);
    const float area = bounds_half_area(&range->box);
    const bool pays = best.cost + costs->node * area < price(costs, &range->box, range->weight);
    if (best.axis >= 0 && (pays || range->weight > LARGEST_LEAF))
        return (Split){
            SPLIT_PLANE,     best.axis, binning.origin[best.axis], binning.scale[best.axis],
            (float)best.bin, best.left};
    return (Split){.kind = range->weight > LARGEST_LEAF ? SPLIT_HALVES : SPLIT_NONE};
}
