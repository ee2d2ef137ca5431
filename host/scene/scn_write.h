// SPDX-License-Identifier: MIT
// Writes a Scene as scene text, exact to the last bit of every number.
#pragma once

#include "scene/scene.h"

#include <stdio.h>

// Writes scene to stream. The objects' meshes are in files of these names beside the text. Returns
// false if the stream has failed.
bool scn_write(const Scene *scene, char *const *mesh_names, FILE *stream, Error *error);

// Returns whether scene text can contain a file of that name.
bool scn_write_can_name(const char *name);
