// SPDX-License-Identifier: MIT
// Text in the window's upper left corner, on a translucent background.
#pragma once

#include "view/draw/shader.h"

#include <stdint.h>

typedef struct {
    GLuint program, vertices, array;
} TextView;

bool text_view_open(TextView *view, Error *error);
void text_view_close(TextView *view);

// Draws the text, and breaks lines that are too long.  scale is the size of a font dot in pixels.
void text_view_draw(const TextView *view, const char *text, uint32_t width, uint32_t height,
                    uint32_t scale);
