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

// Fills flat, which the caller frees.  Leaves the tree in *bvh, which the caller frees too, unless
// bvh is NULL.
bool scene_compile(FlatScene *flat, Bvh *bvh, const CompileSource *source, Error *error);
