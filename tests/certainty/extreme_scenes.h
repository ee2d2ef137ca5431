// SPDX-License-Identifier: MIT
// Scenes at the limits of float arithmetic: slivers, distant objects, spheres as large as planets,
// contacts, crossing planes, mirrors that face each other, and many mirroring balls.
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

// Returns 200 random mirroring balls on a huge ball. Some balls touch each other, and some are
// inside other balls.
Scene extreme_marbles(uint64_t seed);
