// SPDX-License-Identifier: MIT
// Draws each box as an instance of a cube's edges or of a cube's diagonal.
#include "view/draw/draw.h"

#include <stddef.h>

bool line_view_open(LineView *view, bool is_diagonal, Error *error)
{
    static const char *const attributes[] = {"corner", "low", "high", NULL};
    *view = (LineView){.program = shader_build(shader_lines, attributes, error),
                       .is_diagonal = is_diagonal};
    if (view->program == 0)
        return false;
    glGenVertexArrays(1, &view->array);
    glBindVertexArray(view->array);
    view->corners = cube_make_edges(0);
    glGenBuffers(1, &view->boxes);
    glBindBuffer(GL_ARRAY_BUFFER, view->boxes);
    shader_set_attribute(1, 3, sizeof(Box), offsetof(Box, low));
    shader_set_attribute(2, 3, sizeof(Box), offsetof(Box, high));
    glVertexAttribDivisor(1, 1);
    glVertexAttribDivisor(2, 1);
    glBindVertexArray(0);
    return true;
}

void line_view_close(LineView *view)
{
    glDeleteProgram(view->program);
    glDeleteVertexArrays(1, &view->array);
    glDeleteBuffers(1, &view->corners);
    glDeleteBuffers(1, &view->boxes);
    *view = (LineView){0};
}

void line_view_load(LineView *view, const Box *boxes, size_t count)
{
    view->count = (uint32_t)count;
    glBindBuffer(GL_ARRAY_BUFFER, view->boxes);
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(count * sizeof *boxes), boxes, GL_STATIC_DRAW);
}

void line_view_draw(const LineView *view, const Lens *lens, const float color[3])
{
    glUseProgram(view->program);
    glBindVertexArray(view->array);
    lens_apply(lens, view->program);
    shader_set_vector(view->program, "paint", color);
    if (view->is_diagonal)
        glDrawArraysInstanced(GL_LINES, CUBE_EDGE_VERTICES, 2, (GLsizei)view->count);
    else
        glDrawArraysInstanced(GL_LINES, 0, CUBE_EDGE_VERTICES, (GLsizei)view->count);
    glBindVertexArray(0);
}
