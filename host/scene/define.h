// SPDX-License-Identifier: MIT
// The statements `define` and `material`: named materials beside the course's four numbered ones.
#pragma once

#include "scene/scene.h"
#include "scene/tokens.h"

// Reads the rest of a define statement and adds the material to scene.
bool materials_define(Scene *scene, Tokens *tokens);

// The selection of `material own`: the materials of mesh files, or the course's material 0 without
// any.
#define MATERIAL_OWN UINT32_MAX

// Reads the argument of `material`: a number of the course, a defined name, or own. As in the
// course, any number but 0 to 3 selects the silhouette.
bool materials_select(const Scene *scene, Tokens *tokens, uint32_t *material);

void material_set_shininess(Material *material, float shininess);
