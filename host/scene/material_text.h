// SPDX-License-Identifier: MIT
// Materials in scene text: the shader's name, then properties, each with its numbers.
#pragma once

#include "scene/scene.h"
#include "scene/tokens.h"

// A property of materials: `count` floats. The first is in [least, most], and all others in [0, 1].
typedef struct {
    const char *name;
    size_t offset; // of the floats in Material
    int count;
    double least, most;
    bool is_shine; // only Blinn-Phong materials use it
} MaterialProperty;

#define MATERIAL_PROPERTIES 7

// In the order in which scn_write writes them.
extern const MaterialProperty material_properties[MATERIAL_PROPERTIES];

// Reads the rest of a define statement after the name. Missing properties get the course's values
// for the material's shader.
bool material_read(Material *material, Tokens *tokens);
