// SPDX-License-Identifier: MIT
// Scene file -> what both views draw: the scene, its triangles in the frame they are traced in and
// their tree.  One thread makes it and others read it, so it is shared and counted.
#pragma once

#include "accel/bvh.h"

#include <stdatomic.h>

typedef struct {
    atomic_uint holders;
    const char *path; // that it was loaded from, as it was given
    Scene scene;
    Normalization normalization;
    Triangles triangles;
    Bvh bvh; // without nodes until the tree is built
} Model;

// Reads the scene or mesh at path, a string that outlives the model; the caller holds the model.
// NULL with the reason where it cannot be read.
Model *model_load(const char *path, uint32_t threads, Error *error);

// Builds the tree of a model that nobody else holds, or whose tree nobody else looks at yet.
bool model_build_tree(Model *model, const BvhSettings *settings, uint32_t threads, Error *error);

// One more holder.
Model *model_hold(Model *model);

// One holder less; the last one frees the model.  NULL is nothing.
void model_release(Model *model);
