// SPDX-License-Identifier: MIT
// Options -> the window.
#pragma once

#include "cli/exit_code.h"
#include "cli/options/options.h"
#include "device/cache.h"

#include <stdio.h>

// Writes what the keys of the window do; nothing in a build without one.
void show_write_keys(FILE *stream);

// Shows the scene in a window until the user closes it.
ExitCode show_scene(const Options *options, const Cache *cache, Error *error);
