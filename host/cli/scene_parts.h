// SPDX-License-Identifier: MIT
// Scene -> the kernel features that it needs, with reasons, and its buffers on the device.
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

// A buffer of the scene on the device.
typedef struct {
    const char *name;
    size_t bytes; // 0: not uploaded
} SceneArray;

#define SCENE_ARRAYS RENDERER_ARRAYS

// scene_parts_list fills parts in the order of ScenePartKind; the run's renderer must be open.
// scene_arrays_list fills arrays.
void scene_parts_list(const Run *run, ScenePart parts[SCENE_PARTS]);
void scene_arrays_list(const FlatScene *flat, SceneArray arrays[SCENE_ARRAYS]);

// Return the reason for the choice of the kernel family, and for specialized or general kernels.
const char *scene_family_reason(const Run *run);
const char *scene_program_reason(const Run *run);
