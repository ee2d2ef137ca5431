// SPDX-License-Identifier: MIT
// Scene -> what it lacks for a picture that shows something.
#pragma once

#include "scene/scene.h"

typedef struct {
    const char *kind; // a name for programs; NULL where nothing is missing
    const char *text; // a clause for people
} MissingPart;

// Returns the first part that is missing: anything to draw, or lights on surfaces that they shade.
MissingPart scene_missing(const Scene *scene);
