// SPDX-License-Identifier: MIT
// Divides the nodes of a tree. split_midpoint or split_sah chooses a node's split, and build_divide
// applies the split.
//
// A split copies a node's triangles from one array to the same range of a second array, left side
// first. The splits of the children copy the triangles back to the first array. Two arrays
// therefore suffice, and the ranges of pending nodes never overlap. An explicit stack holds the
// pending nodes, so no recursion overflows.
//
// Invariant: a split and the order of the triangles on each side depend only on the node's
// triangles, their order, the node's depth, and the tree's settings and size. The tree is therefore
// the same for every number of threads.
#include "accel/build.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

// The midpoint split, as taught in the course (docs/scenes.md), divides a box by a plane through
// its middle, perpendicular to its longest axis. If a side is empty, or if a child is longer than
// LARGEST_CHILD times its parent along this axis, the next longest axis is tried.

#define LEAF_TRIANGLES 4
#define LARGEST_CHILD  0.9f // largest extent of a child, relative to its parent's extent

// Returns the largest number of levels: 10 more than in a balanced tree with four triangles per
// leaf.
static uint32_t deepest_level(uint32_t triangle_count)
{
    const uint32_t leaves = (uint32_t)(triangle_count / 4.0 + 0.5);
    uint32_t levels = 0;
    while (leaves > 1u << levels && levels < 31)
        levels++;
    return 10 + 1 + levels;
}

static void axes_by_extent(const BuildBox *box, int axes[3])
{
    for (int axis = 0; axis < 3; axis++)
        axes[axis] = axis;
    for (int pass = 0; pass < 2; pass++)
        for (int i = 0; i < 2; i++)
            if (build_box_extent(box, axes[i]) < build_box_extent(box, axes[i + 1])) {
                const int longer = axes[i + 1];
                axes[i + 1] = axes[i];
                axes[i] = longer;
            }
}

static bool makes_progress(const BuildRange *range, Split *split)
{
    const float largest = LARGEST_CHILD * build_box_extent(&range->box, split->axis);
    BuildBox sides[2] = {build_box_empty(), build_box_empty()};
    uint32_t counts[2] = {0};
    for (uint32_t i = 0; i < range->count; i++) {
        const bool left = split_is_left(split, &range->items[i]);
        build_box_unite(&sides[left], &range->items[i].box);
        counts[left]++;
    }
    split->left = counts[1];
    return counts[0] > 0 && counts[1] > 0 && build_box_extent(&sides[0], split->axis) <= largest &&
           build_box_extent(&sides[1], split->axis) <= largest;
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

// The binned surface area heuristic (Wald, "On fast construction of SAH-based bounding volume
// hierarchies", 2007). It compares up to 15 planes per axis and takes the plane with the lowest
// expected cost per ray. A node of at most LARGEST_LEAF triangles becomes a leaf if no plane is
// cheaper than testing them all.

#define BINS 16

// Small nodes are numerous, and fewer bins suffice for them.
#define FEW_ITEMS 32
#define FEW_BINS  8

// The largest number of triangles in a leaf.
#define LARGEST_LEAF 8

// From this depth on, nodes that are too large for a leaf are halved. Halving bounds the depth of
// the tree.
#define MEDIAN_SPLIT_DEPTH 32

// The unit of all costs is one intersection test, of one triangle or of one block.
typedef struct {
    uint32_t unit, unit_bits; // triangles per test, and the binary logarithm of this number
    float node;               // cost of reading a node and testing its two boxes
} Costs;

static const Costs costs_of[] = {[LEAVES_SINGLE] = {1, 0, 1.0f}, [LEAVES_BLOCKS] = {8, 3, 0.3f}};

// Each bin has one box per axis, so that vector operations price three planes at once.
typedef struct {
    BuildBox boxes[BINS][3];
    Uint4 counts[BINS];
} Bins;

// On each axis, an item with center c belongs to bin floor((2 c - origin) * scale). The scale of an
// axis is 0 if all centers are (almost) equal there.
typedef struct {
    Float4 origin, scale;
    int bins;
} Binning;

typedef struct {
    int axis; // -1 if there is no plane
    int bin;  // the first bin of the right side
    uint32_t left;
    float price;
} Plane;

// Returns the number of tests that a leaf of counts[i] triangles needs, for each i.
static Float4 units_of(const Costs *costs, Uint4 counts)
{
    const Uint4 units = (counts + (costs->unit - 1)) >> costs->unit_bits;
    return __builtin_convertvector(units, Float4);
}

static Binning binning_of(const BuildBox *centers, uint32_t count)
{
    Binning binning = {centers->low, {0}, count <= FEW_ITEMS ? FEW_BINS : BINS};
    for (int axis = 0; axis < 3; axis++) {
        const float extent = build_box_extent(centers, axis);
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
            bins->boxes[bin][axis] = build_box_empty();
        bins->counts[bin] = (Uint4){0};
    }
}

static void fill_item(Bins *bins, const BuildItem *item, const Binning *binning)
{
    const BuildBox box = item->box;
    const Float4 place = (box.low - box.negated_high - binning->origin) * binning->scale;
    for (int axis = 0; axis < 3; axis++) {
        const int bin = (int)place[axis];
        build_box_unite(&bins->boxes[bin][axis], &box);
        bins->counts[bin][axis]++;
    }
}

static void fill_bins(Bins *bins, const BuildRange *range, const Binning *binning)
{
    clear_bins(bins, binning->bins);
    for (uint32_t i = 0; i < range->count; i++)
        fill_item(bins, &range->items[i], binning);
}

// The boxes and triangle counts on one side of three planes, one plane per axis.
typedef struct {
    BuildBox boxes[3];
    Uint4 counts;
} Sides;

static Sides sides_empty(void)
{
    return (Sides){{build_box_empty(), build_box_empty(), build_box_empty()}, {0}};
}

static void sides_add(Sides *sides, const Bins *bins, int bin)
{
    for (int axis = 0; axis < 3; axis++)
        build_box_unite(&sides->boxes[axis], &bins->boxes[bin][axis]);
    sides->counts += bins->counts[bin];
}

// Returns a side's price on each axis: half its surface area times its number of tests. An empty
// side's price is NaN.
static Float4 sides_price(const Sides *sides, const Costs *costs)
{
    return build_box_half_areas(sides->boxes) * units_of(costs, sides->counts);
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
    const float area = build_box_half_area(&range->box);
    const float units = units_of(costs, (Uint4){range->count})[0];
    const bool pays = best.price + costs->node * area < units * area;
    if (best.axis >= 0 && (pays || range->count > LARGEST_LEAF))
        return (Split){
            SPLIT_PLANE,     best.axis, binning.origin[best.axis], binning.scale[best.axis],
            (float)best.bin, best.left};
    return (Split){.kind = range->count > LARGEST_LEAF ? SPLIT_HALVES : SPLIT_NONE};
}

static BuildItem *items_of(const Build *build, const BuildTask *task)
{
    return build->items[task->depth % 2] + task->first;
}

static BuildRange range_of(const Build *build, const BuildTask *task)
{
    BuildRange range = {.items = items_of(build, task),
                        .count = task->count,
                        .box = build_box_empty(),
                        .centers = build_box_empty(),
                        .depth = task->depth,
                        .total = build->total,
                        .leaves = build->leaves};
    for (uint32_t i = 0; i < range.count; i++) {
        const BuildBox center = build_box_of_center(&range.items[i].box);
        build_box_unite(&range.box, &range.items[i].box);
        build_box_unite(&range.centers, &center);
    }
    return range;
}

// Copies the items of the left side to `other`, followed by the items of the right side. Each side
// keeps its order.
static void move_sides(const BuildRange *range, const Split *split, BuildItem *other)
{
    BuildItem *left = other, *right = other + split->left;
    for (uint32_t i = 0; i < range->count; i++) {
        const bool is_left = split_is_left(split, &range->items[i]);
        BuildItem *place = is_left ? left : right;
        *place = range->items[i];
        left += is_left;
        right += !is_left;
    }
}

static int longest_axis(const BuildBox *box)
{
    int longest = 0;
    for (int axis = 1; axis < 3; axis++)
        if (build_box_extent(box, axis) > build_box_extent(box, longest))
            longest = axis;
    return longest;
}

static int compare_centers(const void *first, const void *second, void *axis)
{
    const BuildItem *a = first, *b = second;
    const float x = item_center(a, *(int *)axis), y = item_center(b, *(int *)axis);
    if (x != y)
        return x < y ? -1 : 1;
    return a->number < b->number ? -1 : 1;
}

// Copies the items to `other`, sorted by center along the axis on which the centers extend most.
// The caller gives each child half of the items, which is possible even if all centers are equal.
static void move_halves(const BuildRange *range, BuildItem *other)
{
    int axis = longest_axis(&range->centers);
    memcpy(other, range->items, range->count * sizeof *other);
    if (build_box_extent(&range->centers, axis) > 0)
        qsort_r(other, range->count, sizeof *other, compare_centers, &axis);
}

static void make_leaf(const Build *build, const BuildTask *task)
{
    const BuildItem *items = items_of(build, task);
    build->bvh->nodes[task->node].first = task->first;
    build->bvh->nodes[task->node].count = task->count;
    for (uint32_t i = 0; i < task->count; i++)
        build->bvh->order[task->first + i] = items[i].number;
}

void build_divide(const Build *build, BuildTask *task)
{
    BuildItem *other = build->items[(task->depth + 1) % 2] + task->first;
    assert(task->depth <= BVH_MAX_DEPTH);
    const BuildRange range = range_of(build, task);
    const Split split = build->split(&range);
    build->bvh->nodes[task->node].box = build_box_plain(&range.box);
    task->left = split.left;
    switch (split.kind) {
    case SPLIT_NONE:
        make_leaf(build, task);
        break;
    case SPLIT_PLANE:
        move_sides(&range, &split, other);
        break;
    case SPLIT_HALVES:
        move_halves(&range, other);
        task->left = task->count / 2;
        break;
    }
}

void build_set_children(const Build *build, const BuildTask *task, uint32_t child,
                        BuildTask children[2])
{
    BvhNode *node = &build->bvh->nodes[task->node];
    const uint32_t left = task->left, depth = task->depth + 1;
    node->first = child;
    node->count = 0;
    children[0] = (BuildTask){child, task->first, left, depth, 0};
    children[1] = (BuildTask){child + 1, task->first + left, task->count - left, depth, 0};
}

void build_subtree(const Build *build, const BuildTask *root)
{
    BuildTask stack[BVH_STACK_SIZE] = {*root};
    uint32_t child = 2 * root->first + 1;
    for (uint32_t count = 1; count > 0;) {
        BuildTask next = stack[--count];
        build_divide(build, &next);
        if (next.left == 0)
            continue;
        build_set_children(build, &next, child, stack + count);
        count += 2;
        child += 2;
    }
}
