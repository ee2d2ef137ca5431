// SPDX-License-Identifier: MIT
// Tells when the scene or the kernels have to be read again.
#pragma once

#include "scene/scene.h"
#include "view/watch.h"

typedef struct {
    Watch scene, kernels;
    double looked; // moment
} Reload;

typedef enum { RELOAD_SCENE = 1, RELOAD_KERNELS = 2 } ReloadBits;

// Watches the files that the scene, NULL for none, was read from.  Where reading them has failed
// since, a file may be missing, so the scene file's folder counts too.
bool reload_follow(Reload *reload, const Scene *scene, const char *path, bool has_failed,
                   Error *error);

// Watches the kernels of a folder, NULL for none.
bool reload_follow_kernels(Reload *reload, const char *folder, Error *error);

// Looks, if it is time to, and returns the ReloadBits of what has changed.
unsigned reload_look(Reload *reload, double now);
void reload_free(Reload *reload);
