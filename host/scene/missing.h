// SPDX-License-Identifier: MIT
// Finds what a scene lacks to show anything.
#pragma once

#include "scene/scene.h"

typedef struct {
    const char *kind; // a name for programs; NULL if nothing is missing
    const char *text; // a clause for messages
} MissingPart;

// Returns the first missing part: anything to render, or lights on surfaces that need them.
MissingPart scene_missing(const Scene *scene);
