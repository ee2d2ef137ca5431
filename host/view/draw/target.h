// SPDX-License-Identifier: MIT
// An offscreen picture, which is larger than the window if the picture is anti-aliased. clrt saves
// this picture instead of the window's buffer, which has undefined pixels where other windows cover
// the window.
#pragma once

#include "image/framebuffer.h"

#include <epoxy/gl.h>

typedef struct {
    GLuint frames[2];       // framebuffers: the drawn one, and the displayed one
    GLuint buffers[3];      // color and depth of frames[0], color of frames[1]
    uint32_t width, height; // size of the displayed frame
    uint32_t factor;        // ratio of the drawn frame's sides to the displayed frame's sides
} Target;

void target_open(Target *target);
void target_close(Target *target);

// Begins a picture of width x height pixels, with factor x factor samples per pixel.
bool target_begin(Target *target, uint32_t width, uint32_t height, uint32_t factor, Error *error);

// Finishes the picture and copies it to the window's buffer.
void target_show(const Target *target);

// Reads the displayed picture into a new framebuffer, with colors from 0 to 1.
bool target_read(const Target *target, Framebuffer *framebuffer, Error *error);
