// SPDX-License-Identifier: MIT
// Scene file -> Model: the scene, the scene's normalized triangles, and a tree over the triangles.
// Both the OpenGL view and the ray-traced view draw a model. Models are reference-counted, because
// one thread makes a model and others read it.
#pragma once

#include "scene/scn.h"
#include "session/session.h"

#include <stdatomic.h>

typedef struct {
    atomic_uint holders;
    const char *path; // as given to model_load
    Scene scene;
    Normalization normalization;
    CompileStages stages; // without a tree until model_build_tree returns
} Model;

// Reads the scene or mesh file at `path`. Returns a model with one reference, or NULL on failure.
// The string `path` must outlive the model.
Model *model_load(const char *path, const SceneLoadOptions *options, uint32_t threads,
                  Error *error);

// Builds the tree. No other thread may read the tree before the function returns.
bool model_build_tree(Model *model, const BvhSettings *settings, uint32_t threads, Error *error);

// Adds a reference and returns the model.
Model *model_hold(Model *model);

// Drops a reference. Dropping the last reference frees the model. Accepts NULL.
void model_release(Model *model);
