// SPDX-License-Identifier: MIT
// The camera of the rays -> the projection with which OpenGL draws the same picture.
#pragma once

#include "scene/camera.h"
#include "view/draw/shader.h"

typedef struct {
    CameraData camera; // in the normalized frame; a step is half a pixel
    Vec3 eye;          // in that frame, in fp64
    float clip_x[3], clip_y[3];
    float width, height; // of the picture, in pixels
    float nearest;       // the smallest distance with depth
} Lens;

Lens lens_of(const Viewpoint *viewpoint, const Normalization *normalization, uint32_t width,
             uint32_t height);

// Sets the lens's uniforms in the current program.
void lens_apply(const Lens *lens, GLuint program);
