// SPDX-License-Identifier: MIT
// One scene with smooth and flat triangles, spheres, mirrors, highlights, shadows and several
// lights, for pictures that must not change by a bit.
#pragma once

#include "picture.h"

Scene varied_scene(void);

// Multiplies all lengths and places of a scene with one viewpoint by scale, and then adds move.
void varied_scene_place(Scene *scene, double scale, Vec3 move);
