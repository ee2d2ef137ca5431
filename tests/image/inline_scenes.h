// SPDX-License-Identifier: MIT
// Scenes with features that no scene of the course has. They are written to files in a temporary
// folder.
#pragma once

#include "base/error.h"

#define INLINE_PATH_SIZE 256

typedef struct {
    char folder[INLINE_PATH_SIZE];
} InlineScenes;

typedef enum {
    INLINE_OPEN_SHEET,
    INLINE_MIRRORS,
    INLINE_FAR_AWAY,
    INLINE_DISTANT_LIGHTS,
    INLINE_COUNT
} InlineScene;

// Creates the folder and its files.
bool inline_scenes_write(InlineScenes *scenes, Error *error);

// Removes the folder and its files.
void inline_scenes_remove(InlineScenes *scenes);

// The scenes of a test program, with the setup and teardown of its group of tests.
extern InlineScenes inline_scenes;
int inline_scenes_set_up(void **state);
int inline_scenes_tear_down(void **state);

void inline_scenes_path(const InlineScenes *scenes, InlineScene scene, char path[INLINE_PATH_SIZE]);
