// SPDX-License-Identifier: MIT
// Turns a Scene into a tree and a FlatScene, by the stages of clrt.
#pragma once

#include "accel/flat.h"

typedef enum {
    TREE_SAH,
    TREE_MIDPOINT,
    TREE_NONE,
    TREE_KINDS,
    // Valid trees that no builder makes, because these trees ignore where triangles are. The first
    // four halve the triangles in file order down to leaves of at most 1, 2, 4 or 8 triangles. The
    // deepest tree has up to BVH_MAX_DEPTH levels. Each level but the last separates one triangle
    // from the rest.
    TREE_LEAVES_1 = TREE_KINDS,
    TREE_LEAVES_2,
    TREE_LEAVES_4,
    TREE_LEAVES_8,
    TREE_DEEPEST,
    TREE_ALL_KINDS
} TreeKind;

extern const char *const tree_names[TREE_ALL_KINDS];

typedef struct {
    Normalization normalization;
    Triangles triangles; // normalized
    Bvh bvh;             // empty for TREE_NONE
    FlatScene flat;
} Stage;

// Any failure ends the test. The stage does not refer to scene. stage_make uses the node layout of
// form_choice.
void stage_make(Stage *stage, const Scene *scene, TreeKind tree);
void stage_make_as(Stage *stage, const Scene *scene, TreeKind tree, NodeLayout layout);
void stage_free(Stage *stage);

Vec3 corner_of(const Triangles *triangles, size_t triangle, size_t corner);

// Returns the triangle's point a + u * (b - a) + v * (c - a).
Vec3 point_of(const Triangles *triangles, size_t triangle, double u, double v);

// Returns the triangle's normal of length 1.
Vec3 normal_of(const Triangles *triangles, size_t triangle);

static inline Box box_empty(void)
{
    return (Box){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
}

// Extends box to contain the points from low to high.
static inline void box_include(Box *box, const float low[3], const float high[3])
{
    for (int axis = 0; axis < 3; axis++) {
        box->low[axis] = low[axis] < box->low[axis] ? low[axis] : box->low[axis];
        box->high[axis] = high[axis] > box->high[axis] ? high[axis] : box->high[axis];
    }
}
