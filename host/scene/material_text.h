// SPDX-License-Identifier: MIT
// Materials in scene text: the shader's name, then properties, each with its numbers.
#pragma once

#include "scene/scene.h"
#include "scene/tokens.h"

#include <stdio.h>

// Reads the rest of a define statement after the name. Missing properties get the course's values
// for the material's shader.
bool material_read(Material *material, Tokens *tokens);

// Writes text that material_read reads back, without the properties that the shader ignores.
void material_write(const Material *material, FILE *stream);
