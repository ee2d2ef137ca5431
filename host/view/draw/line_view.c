// SPDX-License-Identifier: MIT
// Draws each box as an instance of a cube's edges or of a cube's diagonal.
#include "view/draw/draw.h"

#include <stddef.h>

bool line_view_open(LineView *view, bool is_diagonal, Error *error)
{
    static const DrawingLayout layout = {shader_lines,
                                         {3 * sizeof(float), sizeof(Box)},
                                         {{"corner", 0, 3, 0},
                                          {"low", 1, 3, offsetof(Box, low)},
                                          {"high", 1, 3, offsetof(Box, high)}}};
    *view = (LineView){.is_diagonal = is_diagonal};
    const bool ok = drawing_open(&view->drawing, &layout, error);
    cube_fill_edges(&view->drawing);
    return ok;
}

void line_view_load(LineView *view, const Box *boxes, size_t count)
{
    view->count = (uint32_t)count;
    drawing_fill(&view->drawing, 1, boxes, count * sizeof *boxes);
}

void line_view_draw(const LineView *view, const Lens *lens, const float color[3])
{
    drawing_use(&view->drawing);
    lens_apply(lens, view->drawing.program);
    shader_set_vector(view->drawing.program, "paint", color);
    if (view->is_diagonal)
        glDrawArraysInstanced(GL_LINES, CUBE_EDGE_VERTICES, 2, (GLsizei)view->count);
    else
        glDrawArraysInstanced(GL_LINES, 0, CUBE_EDGE_VERTICES, (GLsizei)view->count);
    glBindVertexArray(0);
}
