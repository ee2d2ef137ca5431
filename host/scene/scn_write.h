// SPDX-License-Identifier: MIT
// Scene -> scene text that says the same, to the last bit of every number.
#pragma once

#include "scene/scene.h"

#include <stdio.h>

// Writes scene, whose objects' meshes are in the files of these names, beside the text; false where
// the stream has failed.
bool scn_write(const Scene *scene, char *const *mesh_names, FILE *stream, Error *error);

// Whether a file of that name can be named in a scene.
bool scn_write_can_name(const char *name);
