// SPDX-License-Identifier: MIT
// Scenes with features that no scene of the course has. Programs that contain inline_scenes.c have
// them as files in a temporary folder while their tests run.
#pragma once

#define INLINE_PATH_SIZE 256

typedef enum {
    INLINE_OPEN_SHEET,
    INLINE_MIRRORS,
    INLINE_FAR_AWAY,
    INLINE_DISTANT_LIGHTS,
    INLINE_COUNT
} InlineScene;

void inline_scenes_path(InlineScene scene, char path[INLINE_PATH_SIZE]);
