// SPDX-License-Identifier: MIT
// Scene -> FlatScene by all stages: triangles, tree, flattening.
#pragma once

#include "accel/flat.h"

typedef struct {
    const Scene *scene;
    const Normalization *normalization; // of the scene
    NodeLayout layout;
    BvhBuilder builder;
    bool has_tree;    // otherwise rays test every triangle
    ThreadPool *pool; // shares the work; NULL for none
} CompileSource;

// Fills flat. Stores the tree in *bvh unless bvh is NULL. The caller frees both.
bool scene_compile(FlatScene *flat, Bvh *bvh, const CompileSource *source, Error *error);
