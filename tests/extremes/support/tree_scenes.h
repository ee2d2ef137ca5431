// SPDX-License-Identifier: MIT
// Twelve scenes that are hard for trees: flat, far, thin, equal, nested and mixed. Each is small
// enough to test every triangle.
#pragma once

#include "scene/scene.h"

#define TREE_SCENES 12

extern const char *const tree_scene_names[TREE_SCENES];

// Returns the same scene at every call. The caller frees it.
Scene tree_scene_make(size_t number);
