// SPDX-License-Identifier: MIT
// Boxes, or their diagonals, in one color.
#pragma once

#include "accel/bvh.h"
#include "view/lens.h"

typedef struct {
    GLuint program, corners, boxes, array;
    bool is_diagonal;
    uint32_t count; // of loaded boxes
} LineView;

// With is_diagonal, draws a line from each box's low corner to its high one, in any direction.
bool line_view_open(LineView *view, bool is_diagonal, Error *error);
void line_view_close(LineView *view);

void line_view_load(LineView *view, const Box *boxes, size_t count);
void line_view_draw(const LineView *view, const Lens *lens, const float color[3]);
