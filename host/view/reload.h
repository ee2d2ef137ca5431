// SPDX-License-Identifier: MIT
// Detects changes of the scene's files and of the kernels.
#pragma once

#include "scene/scene.h"
#include "view/watch.h"

typedef struct {
    Watch scene, kernels;
    double polled; // time of the latest check
} Reload;

typedef enum { RELOAD_SCENE = 1, RELOAD_KERNELS = 2 } ReloadBits;

// Watches the files of the scene, which may be NULL.  After a failed read a file may be missing, so
// the scene file's folder is watched, too.
bool reload_follow(Reload *reload, const Scene *scene, const char *path, bool has_failed,
                   Error *error);

// Watches the kernels in a folder; NULL for none.
bool reload_follow_kernels(Reload *reload, const char *folder, Error *error);

// Checks the files if it is time, and returns the ReloadBits of the changed ones.
unsigned reload_poll(Reload *reload, double now);
void reload_free(Reload *reload);
