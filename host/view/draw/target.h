// SPDX-License-Identifier: MIT
// An offscreen picture, larger than the window if anti-aliased.  The window's own buffer would lose
// the pixels covered by other windows.
#pragma once

#include "image/framebuffer.h"
#include "view/draw/shader.h"

typedef struct {
    GLuint frames[2];       // drawn, displayed
    GLuint buffers[3];      // color and depth of the first, color of the second
    uint32_t width, height; // of the displayed frame
    uint32_t factor;        // of the drawn frame's sides to the displayed one's
} Target;

void target_open(Target *target);
void target_close(Target *target);

// Begins a picture of width x height pixels, with factor x factor samples per pixel.
bool target_begin(Target *target, uint32_t width, uint32_t height, uint32_t factor, Error *error);

// Finishes the picture and displays it in the window.
void target_show(const Target *target);

// Reads the displayed picture as colors from 0 to 1.
bool target_read(const Target *target, Framebuffer *framebuffer, Error *error);
