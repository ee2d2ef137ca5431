// SPDX-License-Identifier: MIT
// Triangles or boxes of spheres -> the nodes of a Bvh. Comments here call both triangles.
// split_midpoint or split_sah chooses how to split a node.
#pragma once

#include "accel/bvh_tree.h"
#include "accel/triangles.h"

// A box is stored as a vector of low planes and a vector of negated high planes. The union of two
// boxes is then one minimum per vector. No plane is -0, so the order of unions does not affect the
// bits.

#ifdef __SSE__
#include <xmmintrin.h>
#endif

typedef float Float4 __attribute__((vector_size(16)));
typedef uint32_t Uint4 __attribute__((vector_size(16)));

typedef struct {
    Float4 low, negated_high; // x, y, z; in a BuildItem, low[3] holds the triangle's index
} BuildBox;

// A triangle to sort: its box and its index.
typedef union {
    BuildBox box;
    struct {
        float low[3];
        uint32_t number;
        float negated_high[3];
        uint32_t unused;
    };
} BuildItem;

static inline Float4 float4_minimum(Float4 a, Float4 b)
{
#ifdef __SSE__
    return _mm_min_ps(a, b);
#else
    Float4 minimum;
    for (int i = 0; i < 4; i++)
        minimum[i] = a[i] < b[i] ? a[i] : b[i];
    return minimum;
#endif
}

static inline BuildBox build_box_empty(void)
{
    const Float4 nowhere = {INFINITY, INFINITY, INFINITY, INFINITY};
    return (BuildBox){nowhere, nowhere};
}

static inline void build_box_unite(BuildBox *box, const BuildBox *other)
{
    box->low = float4_minimum(box->low, other->low);
    box->negated_high = float4_minimum(box->negated_high, other->negated_high);
}

static inline float build_box_extent(const BuildBox *box, int axis)
{
    return -(box->low[axis] + box->negated_high[axis]);
}

// Returns half the surface area; INFINITY for an empty box.
static inline float build_box_half_area(const BuildBox *box)
{
    const Float4 sides = box->low + box->negated_high;
    return sides[0] * sides[1] + sides[1] * sides[2] + sides[2] * sides[0];
}

// Returns half the surface area of each of three boxes. The fourth component repeats the third.
static inline Float4 build_box_half_areas(const BuildBox boxes[3])
{
    const Float4 a = boxes[0].low + boxes[0].negated_high;
    const Float4 b = boxes[1].low + boxes[1].negated_high;
    const Float4 c = boxes[2].low + boxes[2].negated_high;
    const Float4 ab = __builtin_shufflevector(a, b, 0, 4, 1, 5);
    const Float4 x = __builtin_shufflevector(ab, c, 0, 1, 4, 4);
    const Float4 y = __builtin_shufflevector(ab, c, 2, 3, 5, 5);
    const Float4 z =
        __builtin_shufflevector(__builtin_shufflevector(a, b, 2, 6, 2, 6), c, 0, 1, 6, 6);
    return x * y + y * z + z * x;
}

static inline Box build_box_plain(const BuildBox *box)
{
    Box plain;
    for (int axis = 0; axis < 3; axis++) {
        plain.low[axis] = box->low[axis];
        plain.high[axis] = 0 - box->negated_high[axis];
    }
    return plain;
}

static inline Float4 float4_corner(const Triangles *triangles, uint32_t triangle, int corner)
{
    const float *point = triangles_corner(triangles, triangle, corner);
    return (Float4){point[0], point[1], point[2], point[3]};
}

static inline BuildBox build_box_of_triangle(const Triangles *triangles, uint32_t triangle)
{
    const Float4 zero = {0}, a = float4_corner(triangles, triangle, 0),
                 b = float4_corner(triangles, triangle, 1),
                 c = float4_corner(triangles, triangle, 2);
    // Adding zero turns -0 into 0.
    return (BuildBox){float4_minimum(float4_minimum(a, b), c) + zero,
                      float4_minimum(float4_minimum(-a, -b), -c) + zero};
}

static inline BuildBox build_box_of(const Box *box)
{
    const Float4 zero = {0};
    const Float4 low = {box->low[0], box->low[1], box->low[2]};
    const Float4 high = {box->high[0], box->high[1], box->high[2]};
    return (BuildBox){low + zero, zero - high};
}

// Returns a box of size zero at the point low + high, which is twice the center of the given box.
static inline BuildBox build_box_of_center(const BuildBox *box)
{
    return (BuildBox){box->low - box->negated_high, box->negated_high - box->low};
}

static inline float item_center(const BuildItem *item, int axis)
{
    return item->low[axis] - item->negated_high[axis];
}

// A node to split: the input of split_midpoint and split_sah.
typedef struct {
    const BuildItem *items; // the node's triangles
    uint32_t count;
    BuildBox box;     // of the triangles
    BuildBox centers; // of their doubled centers
    uint32_t depth;   // depth of the node; 1 for the root
    uint32_t total;   // triangles in the whole tree
    BvhLeaves leaves;
} BuildRange;

typedef enum {
    SPLIT_NONE,  // the node is a leaf
    SPLIT_PLANE, // a plane separates the triangles' centers
    SPLIT_HALVES // each child gets half of the triangles
} SplitKind;

// A triangle is left of the plane if (item_center - origin) * scale < limit.
typedef struct {
    SplitKind kind;
    int axis;
    float origin, scale, limit;
    uint32_t left; // SPLIT_PLANE: number of triangles on the left; neither side is empty
} Split;

// Return the split of a range. Both functions are deterministic and stateless.
Split split_midpoint(const BuildRange *range);
Split split_sah(const BuildRange *range);

static inline bool split_is_left(const Split *split, const BuildItem *item)
{
    return (item_center(item, split->axis) - split->origin) * split->scale < split->limit;
}

// A node to divide.
typedef struct {
    uint32_t node;
    uint32_t first, count; // range of its triangles in Bvh::order
    uint32_t depth;        // 1 for the root of the tree
    uint32_t left; // number of triangles in the first child, set by build_divide; 0 for a leaf
} BuildTask;

typedef struct {
    Bvh *bvh;
    uint32_t total;      // triangles in the tree
    BuildItem *items[2]; // [0]: the triangles of nodes at even depths, [1]: at odd depths
    Split (*split)(const BuildRange *range);
    BvhLeaves leaves;
} Build;

// Sorts a node's triangles into two children, or makes the node a leaf.
void build_divide(const Build *build, BuildTask *task);

// Makes the nodes `child` and `child + 1` the children of a divided node, and stores their tasks in
// `children`.
void build_set_children(const Build *build, const BuildTask *task, uint32_t child,
                        BuildTask children[2]);

// Builds the subtree of `root`. The nodes below `root` get indices from 2 * root->first + 1 to 2 *
// (root->first + root->count) - 2, which no other subtree uses.
void build_subtree(const Build *build, const BuildTask *root);
