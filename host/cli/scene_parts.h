// SPDX-License-Identifier: MIT
// What a scene makes clrt compile and upload -> parts, each with its reason.
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

// Something that kernels are compiled with or without.
typedef struct {
    const char *name;
    bool is_needed;
    bool is_compiled; // the general kernels are compiled with what a scene lacks as well
    char reason[160];
} ScenePart;

// An array of the scene on the device.
typedef struct {
    const char *name;
    size_t bytes; // 0: it is not there
} SceneArray;

#define SCENE_ARRAYS RENDERER_ARRAYS

// Run has opened its renderer; parts are in the order of ScenePartKind.
void scene_parts_list(const Run *run, ScenePart parts[SCENE_PARTS]);
void scene_arrays_list(const FlatScene *flat, SceneArray arrays[SCENE_ARRAYS]);

// Why the kernels are of that family, and why they are special or general.
const char *scene_family_reason(const Run *run);
const char *scene_program_reason(const Run *run);
