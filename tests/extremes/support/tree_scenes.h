// SPDX-License-Identifier: MIT
// Scenes that are hard for trees: flat, far, thin, equal, nested, mixed and tiny. Each is small
// enough to test every triangle.
#pragma once

#include "scene/scene.h"

#define TREE_SCENES 13

extern const char *const tree_scene_names[TREE_SCENES];

// Returns the scene with this index, the same at every call. The caller frees it.
Scene tree_scene_make(size_t number);
