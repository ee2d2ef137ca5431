// SPDX-License-Identifier: MIT
// Scenes at the limits of float arithmetic: slivers, distant objects, spheres as large as planets,
// contacts, crossing planes, and mirrors that face each other.
#pragma once

#include "scene/scene.h"

typedef struct {
    const char *name;
    Scene (*make)(void);
} ExtremeScene;

extern const ExtremeScene extreme_scenes[];
extern const size_t extreme_scene_count;

// Returns a ball over a floor. Each triangle exists twice, and one copy has its corners in a random
// order.
Scene extreme_coincident(void);
