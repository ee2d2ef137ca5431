// SPDX-License-Identifier: MIT
// Twelve scenes that trees find hard: flat, far, thin, equal, nested and mixed, each small enough
// to test every triangle.
#pragma once

#include "random.h"
#include "scene/scene.h"

typedef struct {
    const char *name;
    Scene (*make)(Random *);
} TreeScene;

#define TREE_SCENES 12

extern const TreeScene tree_scenes[TREE_SCENES];

// The same scene whenever it is made.
Scene tree_scene_make(size_t number);
