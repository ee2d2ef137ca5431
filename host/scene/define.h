// SPDX-License-Identifier: MIT
// The statements `define` and `material`: named materials beside the course's four numbers.
#pragma once

#include "scene/scene.h"
#include "scene/tokens.h"

typedef struct {
    char name[64];
    uint32_t material; // index in the scene's materials
} MaterialName;

typedef struct {
    ARRAY(MaterialName) names;
} Materials;

// Reads the rest of a define statement and adds the material to scene.
bool materials_define(Materials *materials, Tokens *tokens, Scene *scene);

// Reads what follows `material`: a number of the course (any but 0 to 3 is the silhouette, as
// there) or a defined name.
bool materials_select(const Materials *materials, Tokens *tokens, uint32_t *material);

void materials_free(Materials *materials);
