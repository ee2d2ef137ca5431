// SPDX-License-Identifier: MIT
// Scene file -> the input of both views: the scene, its triangles in the normalized frame and their
// tree.  One thread makes a model and others read it, so it is reference-counted.
#pragma once

#include "accel/bvh.h"

#include <stdatomic.h>

typedef struct {
    atomic_uint holders;
    const char *path; // the path as given
    Scene scene;
    Normalization normalization;
    Triangles triangles;
    Bvh bvh; // without nodes until the tree is built
} Model;

// Reads the scene or mesh at path, a string that outlives the model, and returns it with one
// reference.  Returns NULL with the reason on failure.
Model *model_load(const char *path, uint32_t threads, Error *error);

// Builds the tree.  No other thread may hold the model or read its tree yet.
bool model_build_tree(Model *model, const BvhSettings *settings, uint32_t threads, Error *error);

// Adds a reference and returns the model.
Model *model_hold(Model *model);

// Drops a reference; the last one frees the model.  Accepts NULL.
void model_release(Model *model);
