// SPDX-License-Identifier: MIT
// The statements `define` and `material`: named materials beside the course's four numbers.
#pragma once

#include "scene/scene.h"
#include "scene/tokens.h"

// Reads the rest of a define statement and adds the material to scene.
bool materials_define(Scene *scene, Tokens *tokens);

// What `material own` selects: the materials of mesh files, and the course's 0 where there are
// none.
#define MATERIAL_OWN UINT32_MAX

// Reads what follows `material`: a number of the course (any but 0 to 3 is the silhouette, as
// there), a defined name, or own.
bool materials_select(const Scene *scene, Tokens *tokens, uint32_t *material);

void material_set_shininess(Material *material, float shininess);
