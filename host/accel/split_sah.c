// SPDX-License-Identifier: MIT
// The binned surface area heuristic (Wald, "On fast construction of SAH-based bounding volume
// hierarchies", 2007). It takes the plane with the lowest expected cost per ray, out of up to 15
// per axis. A small node becomes a leaf if no plane is cheaper than testing its triangles.
#include "accel/build.h"

#define BINS 16

// Small nodes are numerous, and fewer bins suffice for them.
#define FEW_ITEMS 32
#define FEW_BINS  8

// The most triangles in a leaf.
#define LARGEST_LEAF 8

// From this depth on, nodes too large for a leaf are halved. This bounds the depth of the tree.
#define MEDIAN_SPLIT_DEPTH 32

// Costs are relative to one test of a leaf, which covers one triangle or one block.
typedef struct {
    uint32_t unit, unit_bits; // triangles per test, and the binary logarithm
    float node;               // cost of reading a node and testing its two boxes
} Costs;

static const Costs costs_of[] = {[LEAVES_SINGLE] = {1, 0, 1.0f}, [LEAVES_BLOCKS] = {8, 3, 0.3f}};

// Each bin holds all three axes, so that vector operations price three planes at once.
typedef struct {
    Bounds bounds[BINS][3];
    Uint4 counts[BINS];
} Bins;

// An item's bin is floor((doubled center - origin) * scale). The scale is 0 if centers hardly vary.
typedef struct {
    Float4 origin, scale;
    int bins;
} Binning;

typedef struct {
    int axis; // -1 without a plane
    int bin;  // the first bin of the right side
    uint32_t left;
    float price;
} Plane;

// Returns the number of leaf tests for each number of triangles in `counts`.
static Float4 units_of(const Costs *costs, Uint4 counts)
{
    const Uint4 units = (counts + (costs->unit - 1)) >> costs->unit_bits;
    return __builtin_convertvector(units, Float4);
}

static Binning binning_of(const Bounds *centers, uint32_t count)
{
    Binning binning = {centers->low, {0}, count <= FEW_ITEMS ? FEW_BINS : BINS};
    for (int axis = 0; axis < 3; axis++) {
        const float extent = bounds_extent(centers, axis);
        const float scale = (float)binning.bins * 0.999999f / extent;
        binning.scale[axis] = extent > 0 && scale < INFINITY ? scale : 0;
    }
    binning.origin[3] = 1; // avoids slow denormals: BuildItem stores integers there
    return binning;
}

static void clear_bins(Bins *bins, int count)
{
    for (int bin = 0; bin < count; bin++) {
        for (int axis = 0; axis < 3; axis++)
            bins->bounds[bin][axis] = bounds_empty();
        bins->counts[bin] = (Uint4){0};
    }
}

static void fill_item(Bins *bins, const BuildItem *item, const Binning *binning)
{
    const Bounds bounds = item->bounds;
    const Float4 place = (bounds.low - bounds.negated_high - binning->origin) * binning->scale;
    for (int axis = 0; axis < 3; axis++) {
        const int bin = (int)place[axis];
        bounds_unite(&bins->bounds[bin][axis], &bounds);
        bins->counts[bin][axis]++;
    }
}

static void fill_bins(Bins *bins, const BuildRange *range, const Binning *binning)
{
    clear_bins(bins, binning->bins);
    for (uint32_t i = 0; i < range->count; i++)
        fill_item(bins, &range->items[i], binning);
}

// The bounds and triangle counts on one side of three planes, one plane per axis.
typedef struct {
    Bounds bounds[3];
    Uint4 counts;
} Sides;

static Sides sides_empty(void)
{
    return (Sides){{bounds_empty(), bounds_empty(), bounds_empty()}, {0}};
}

static void sides_add(Sides *sides, const Bins *bins, int bin)
{
    for (int axis = 0; axis < 3; axis++)
        bounds_unite(&sides->bounds[axis], &bins->bounds[bin][axis]);
    sides->counts += bins->counts[bin];
}

// Returns the price of a side for each axis: half the surface area times the number of tests. An
// empty side's price is NaN.
static Float4 sides_price(const Sides *sides, const Costs *costs)
{
    return bounds_half_areas(sides->bounds) * units_of(costs, sides->counts);
}

// Returns the cheapest plane. Sweeps once from the right to price the right sides, and once from
// the left to price each plane.
static Plane cheapest_plane(const Bins *bins, int count, const Costs *costs)
{
    Float4 right_prices[BINS];
    Float4 best = {INFINITY, INFINITY, INFINITY, INFINITY};
    Uint4 best_bins = {0}, best_left = {0};
    Sides sides = sides_empty();
    for (int bin = count - 1; bin > 0; bin--) {
        sides_add(&sides, bins, bin);
        right_prices[bin] = sides_price(&sides, costs);
    }
    sides = sides_empty();
    for (int bin = 1; bin < count; bin++) {
        sides_add(&sides, bins, bin - 1);
        const Float4 prices = sides_price(&sides, costs) + right_prices[bin];
        const Uint4 less = (Uint4)(prices < best);
        best = (Float4)((less & (Uint4)prices) | (~less & (Uint4)best));
        best_bins = (less & (uint32_t)bin) | (~less & best_bins);
        best_left = (less & sides.counts) | (~less & best_left);
    }
    Plane plane = {-1, 0, 0, INFINITY};
    for (int axis = 0; axis < 3; axis++)
        if (best[axis] < plane.price)
            plane = (Plane){axis, (int)best_bins[axis], best_left[axis], best[axis]};
    return plane;
}

Split split_sah(const BuildRange *range)
{
    const Costs *costs = &costs_of[range->leaves];
    // One test covers all these triangles, so a split cannot be cheaper.
    if (range->count <= costs->unit)
        return (Split){.kind = SPLIT_NONE};
    Plane best = {-1, 0, 0, INFINITY};
    const Binning binning = binning_of(&range->centers, range->count);
    if (range->depth < MEDIAN_SPLIT_DEPTH) {
        Bins bins;
        fill_bins(&bins, range, &binning);
        best = cheapest_plane(&bins, binning.bins, costs);
    }
    const float area = bounds_half_area(&range->box);
    const float units = units_of(costs, (Uint4){range->count})[0];
    const bool pays = best.price + costs->node * area < units * area;
    if (best.axis >= 0 && (pays || range->count > LARGEST_LEAF))
        return (Split){
            SPLIT_PLANE,     best.axis, binning.origin[best.axis], binning.scale[best.axis],
            (float)best.bin, best.left};
    return (Split){.kind = range->count > LARGEST_LEAF ? SPLIT_HALVES : SPLIT_NONE};
}
