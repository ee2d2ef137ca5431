// SPDX-License-Identifier: MIT
// Text over the picture, on a translucent background: a line at the top and a panel below it.
#pragma once

#include "base/array.h"
#include "base/file.h"
#include "view/draw/drawing.h"

#include <stb/stb_truetype.h>

#define FONT_CHARACTERS 95 // from the blank to the tilde

typedef struct {
    File file;                       // empty without a font
    float advances[FONT_CHARACTERS]; // widths at size 1
    GLuint texture;                  // the characters; its upper left texel is opaque
    int side;                        // of the texture, in pixels
    float size;                      // of the texture's characters, in pixels; 0 if there are none
    stbtt_bakedchar glyphs[FONT_CHARACTERS];
} Font;

// A character's rectangle in the window and in the texture.
typedef struct {
    stbtt_aligned_quad place;
    float color[4];
} TextQuad;

typedef struct {
    Drawing drawing;
    Font font;
    ARRAY(TextQuad) quads; // of the text to draw
} TextView;

typedef struct {
    char *line;             // shortened at commas until it fits the window
    const char *panel;      // made smaller to fit the window; two blanks start a second column
    uint32_t width, height; // of the window in pixels
    float density;          // pixels per 1/96 inch
} TextOverlay;

// Opens the view. If no font is found, the view draws nothing, and *no_font contains the reason.
bool text_view_open(TextView *view, Error *no_font, Error *error);
void text_view_close(TextView *view);

void text_view_draw(TextView *view, const TextOverlay *overlay);
