// SPDX-License-Identifier: MIT
// Scene -> the kernel features that it needs, with reasons.
#pragma once

#include "cli/run.h"

typedef enum {
    PART_SPHERES,
    PART_TRIANGLES,
    PART_TREE,
    PART_LIGHTS,
    PART_MIRRORS,
    PART_STATISTICS,
    SCENE_PARTS
} ScenePartKind;

// A kernel feature that can be omitted at compile time.
typedef struct {
    const char *name;
    bool is_needed;
    bool is_compiled; // general kernels also contain features that the scene does not need
    char reason[160];
} ScenePart;

// Fills parts in the order of ScenePartKind. The run's renderer must be open.
void scene_parts_list(const Run *run, ScenePart parts[SCENE_PARTS]);

// Return the reason for the choice of the kernel family, and for specialized or general kernels.
const char *scene_family_reason(const Run *run);
const char *scene_program_reason(const Run *run);
