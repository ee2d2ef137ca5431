// SPDX-License-Identifier: MIT
// Scene -> all that is traced of it, by the stages of the program's main.
#pragma once

#include "accel/flat.h"

typedef enum {
    TREE_SAH,
    TREE_MIDPOINT,
    TREE_NONE,
    TREE_KINDS,
    // Trees that no builder makes (plain_tree.h): leaves of so many triangles, and as deep as a
    // tree may be.
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

// Lays the nodes out for form_choice.  Scene is needed no longer than the call takes.
void stage_make(Stage *stage, const Scene *scene, TreeKind tree);
void stage_make_as(Stage *stage, const Scene *scene, TreeKind tree, NodeLayout layout);
void stage_free(Stage *stage);

typedef struct {
    float corners[3][3];
} StageTriangle;

StageTriangle stage_triangle(const Triangles *triangles, size_t number);
