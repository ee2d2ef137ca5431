// SPDX-License-Identifier: MIT
// A scene -> the kernel features and buffers that it needs, each with a reason.
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

// A feature that kernels are compiled with or without.
typedef struct {
    const char *name;
    bool is_needed;
    bool is_compiled; // general kernels also contain features that the scene lacks
    char reason[160];
} ScenePart;

// A buffer of the scene on the device.
typedef struct {
    const char *name;
    size_t bytes; // 0: not uploaded
} SceneArray;

#define SCENE_ARRAYS RENDERER_ARRAYS

// Fill the parts in the order of ScenePartKind, and the arrays.  The run's renderer must be open.
void scene_parts_list(const Run *run, ScenePart parts[SCENE_PARTS]);
void scene_arrays_list(const FlatScene *flat, SceneArray arrays[SCENE_ARRAYS]);

// Return the reasons for the kernel family, and for special or general kernels.
const char *scene_family_reason(const Run *run);
const char *scene_program_reason(const Run *run);
