// SPDX-License-Identifier: MIT
// The picture that is drawn before it is shown: not the window's own, which loses what other
// windows cover, and larger than it where it is anti-aliased.
#pragma once

#include "image/framebuffer.h"
#include "view/draw/shader.h"

typedef struct {
    GLuint frames[2];       // what is drawn into, and what is shown
    GLuint buffers[3];      // color and depth of the first, color of the second
    uint32_t width, height; // of what is shown
    uint32_t factor;        // of what is drawn into
} Target;

void target_open(Target *target);
void target_close(Target *target);

// Begins a picture of that size, drawn with factor x factor samples a pixel.
bool target_begin(Target *target, uint32_t width, uint32_t height, uint32_t factor, Error *error);

// Ends it and shows it in the window.
void target_show(const Target *target);

// Reads what was shown as colors from 0 to 1.
bool target_read(const Target *target, Framebuffer *framebuffer, Error *error);
