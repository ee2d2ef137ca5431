// SPDX-License-Identifier: MIT
// Scene -> FlatScene, by all stages of this folder.
#pragma once

#include "accel/flat_scene.h"

// The intermediate results of scene_compile.
typedef struct {
    Triangles triangles;
    Bvh bvh;
} CompileStages;

// Runs all stages: triangles, tree and flattening. Fills *flat, which must be {0}. Also fills
// *stages, unless the source has triangles. The caller frees both, even after a failure.
bool scene_compile(FlatScene *flat, CompileStages *stages, const FlatSource *source, Error *error);
void compile_stages_free(CompileStages *stages);
