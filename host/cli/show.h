// SPDX-License-Identifier: MIT
// Options -> the window.
#pragma once

#include "cli/options.h"
#include "device/cache.h"

typedef enum { SHOW_DONE, SHOW_NO_WINDOW, SHOW_NO_SCENE, SHOW_NO_DEVICE } ShowEnd;

// Writes what the keys of the window do; nothing in a build without one.
void show_write_keys(FILE *stream);

// Shows the scene in a window until the user closes it.
ShowEnd show_scene(const Options *options, const Cache *cache, Error *error);
