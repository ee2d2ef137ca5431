// SPDX-License-Identifier: MIT
// Text in the window's upper left corner, on a ground that lets the picture shine through.
#pragma once

#include "view/draw/shader.h"

#include <stdint.h>

typedef struct {
    GLuint program, vertices, array;
} TextView;

bool text_view_open(TextView *view, Error *error);
void text_view_close(TextView *view);

// Draws the lines, broken where they do not fit; scale is how many pixels a dot of the letters
// takes.
void text_view_draw(const TextView *view, const char *text, uint32_t width, uint32_t height,
                    uint32_t scale);
