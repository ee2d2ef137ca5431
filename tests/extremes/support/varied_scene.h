// SPDX-License-Identifier: MIT
// One scene with smooth and flat triangles, spheres, mirrors, highlights, shadows and several
// lights, for pictures that must not change by a bit.
#pragma once

#include "picture.h"

Scene varied_scene(void);

// Draws the varied scene. The caller frees the picture.
Framebuffer varied_picture(const Studio *studio, const PictureSettings *settings);

// Multiplies all lengths and places of a scene with one viewpoint by 2^exponent.
void varied_scene_scale(Scene *scene, int exponent);
