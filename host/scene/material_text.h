// SPDX-License-Identifier: MIT
// Materials in scene text: the shader's name, then properties, each with its numbers.
#pragma once

#include "scene/scene.h"
#include "scene/tokens.h"

// All shaders except glass accept Blinn-Phong's properties, but only Blinn-Phong uses them.
typedef enum { USED_BY_ALL_BUT_GLASS, USED_BY_BLINN_PHONG, USED_BY_GLASS } PropertyUse;

// A property of materials: `count` floats. The first number is in [least, most], and all other
// numbers are in [0, 1].
typedef struct {
    const char *name;
    const char *usage; // for messages
    size_t offset;     // of the floats in Material
    int count;
    double least, most;
    PropertyUse use;
} MaterialProperty;

#define MATERIAL_PROPERTIES 9

// The properties, in the order in which scn_write writes them.
extern const MaterialProperty material_properties[MATERIAL_PROPERTIES];

// Returns whether a definition of the material may have the property.
static inline bool material_accepts(const Material *material, const MaterialProperty *property)
{
    return (material->shader == SHADER_GLASS) == (property->use == USED_BY_GLASS);
}

// Reads the rest of a `define` statement after the name. Missing properties get the defaults of the
// shader.
bool material_read(Material *material, Tokens *tokens);
