// SPDX-License-Identifier: MIT
// Detects changes of the scene's files and of the kernels.
#pragma once

#include "scene/scene.h"
#include "view/watch.h"

typedef struct {
    Watch scene, kernels;
    double looked; // time of the latest check
} Reload;

typedef enum { RELOAD_SCENE = 1, RELOAD_KERNELS = 2 } ReloadBits;

// Watches the file at path and the other files of scene, which may be NULL. Also watches the folder
// of path if has_failed, because a file may be missing.
bool reload_follow(Reload *reload, const Scene *scene, const char *path, bool has_failed,
                   Error *error);

// Watches the kernels in folder, which may be NULL.
bool reload_follow_kernels(Reload *reload, const char *folder, Error *error);

// Checks the files at most five times a second, and returns the ReloadBits of the changes. now is
// in seconds.
unsigned reload_look(Reload *reload, double now);
void reload_free(Reload *reload);
