// SPDX-License-Identifier: MIT
// The properties of a material that clrt renders are two colors and an exponent. Values come from
// Assimp without checks. The receiver clamps them.
#pragma once

#include "mesh/foreign_stream.h"

#include <assimp/material.h>

// Returns false for a material that Assimp invents because the file has none.
bool material_is_given(const struct aiMaterial *material);

ForeignMaterial material_taken(const struct aiMaterial *material);

// Returns whether the material's color has a texture, which clrt does not render.
bool material_is_textured(const struct aiMaterial *material);
