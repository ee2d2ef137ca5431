// SPDX-License-Identifier: MIT
// Assimp's materials -> what clrt can show of them: two colors and an exponent.
#pragma once

#include "mesh/foreign_stream.h"

#include <assimp/material.h>

// False for what Assimp invents where a file gives no material.
bool material_is_given(const struct aiMaterial *material);

ForeignMaterial material_taken(const struct aiMaterial *material);

// Whether it has a texture for its color, which clrt does not draw.
bool material_is_textured(const struct aiMaterial *material);
