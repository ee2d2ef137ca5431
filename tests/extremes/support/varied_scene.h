// SPDX-License-Identifier: MIT
// One scene with everything in it: smooth and flat triangles, spheres, mirrors, highlights, shadows
// and several lights.  Pictures of it must not change by a bit.
#pragma once

#include "scene/scene.h"

Scene varied_scene(void);

// Multiplies all lengths and places by 2^exponent: triangles, spheres, lights and the viewpoint.
void varied_scene_scale(Scene *scene, int exponent);
