// SPDX-License-Identifier: MIT
// Scenes of what the course's scenes have none of, written as files into a temporary folder.
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

// Makes the folder and its files.
bool inline_scenes_write(InlineScenes *scenes, Error *error);

// Removes what was written.
void inline_scenes_remove(InlineScenes *scenes);

// The same for a program of tests, around all of them.
extern InlineScenes inline_scenes;
int inline_scenes_set_up(void **state);
int inline_scenes_tear_down(void **state);

void inline_scenes_path(const InlineScenes *scenes, InlineScene scene, char path[INLINE_PATH_SIZE]);
