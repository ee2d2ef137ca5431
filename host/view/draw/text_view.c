// SPDX-License-Identifier: MIT
// stb_easy_font converts letters to rectangles.
#include "view/draw/text_view.h"

#include <stb/stb_easy_font.h>
#include <stddef.h>
#include <stdlib.h>

#define TEXT_SIZE     8192
#define QUADS_MAX     16384
#define MARGIN        4
#define LINE_HEIGHT   12
#define QUAD_CORNERS  4
#define QUAD_VERTICES 6

typedef struct {
    float x, y, z;
    unsigned char color[4];
} Vertex;

bool text_view_open(TextView *view, Error *error)
{
    static const char *const attributes[] = {"position", "tint", NULL};
    *view = (TextView){.program = shader_build(shader_text, attributes, error)};
    if (view->program == 0)
        return false;
    glGenVertexArrays(1, &view->array);
    glGenBuffers(1, &view->vertices);
    glBindVertexArray(view->array);
    glBindBuffer(GL_ARRAY_BUFFER, view->vertices);
    glVertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, sizeof(Vertex), (void *)offsetof(Vertex, x));
    glVertexAttribPointer(1, 4, GL_UNSIGNED_BYTE, GL_TRUE, sizeof(Vertex),
                          (void *)offsetof(Vertex, color));
    glEnableVertexAttribArray(0);
    glEnableVertexAttribArray(1);
    glBindVertexArray(0);
    return true;
}

void text_view_close(TextView *view)
{
    glDeleteProgram(view->program);
    glDeleteVertexArrays(1, &view->array);
    glDeleteBuffers(1, &view->vertices);
    *view = (TextView){0};
}

// Replaces characters that the ASCII font lacks.
static void copy_printable(char copy[TEXT_SIZE], const char *text)
{
    size_t length = 0;
    for (; text[length] != '\0' && length < TEXT_SIZE - 1; length++)
        copy[length] = text[length] == '\n' || (text[length] >= ' ' && text[length] <= '~')
                           ? text[length]
                           : '?';
    copy[length] = '\0';
}

// Returns whether the text from line to end is wider than width dots.
static bool is_wider(char *line, char *end, int width)
{
    const char kept = *end;
    *end = '\0';
    const bool wider = stb_easy_font_width(line) > width;
    *end = kept;
    return wider;
}

// Breaks lines at spaces, so that they are at most width dots wide if possible.
static void break_lines(char *text, int width)
{
    char *line = text, *blank = NULL;
    for (char *place = text; *place != '\0'; place++) {
        if (*place == '\n') {
            line = place + 1;
            blank = NULL;
        } else if (*place == ' ') {
            blank = place;
        } else if (blank != NULL && is_wider(line, place + 1, width)) {
            *blank = '\n';
            line = blank + 1;
            blank = NULL;
        }
    }
}

static int count_lines(const char *text)
{
    int count = 1;
    for (; *text != '\0'; text++)
        count += *text == '\n';
    return count;
}

// Splits each quad into two scaled triangles. Returns the number of vertices.
static size_t make_triangles(Vertex *triangles, const Vertex *quads, size_t count, uint32_t scale)
{
    static const int corners[QUAD_VERTICES] = {0, 1, 2, 0, 2, 3};
    for (size_t quad = 0; quad < count; quad++)
        for (int i = 0; i < QUAD_VERTICES; i++) {
            Vertex vertex = quads[QUAD_CORNERS * quad + (size_t)corners[i]];
            vertex.x *= (float)scale;
            vertex.y *= (float)scale;
            triangles[QUAD_VERTICES * quad + (size_t)i] = vertex;
        }
    return QUAD_VERTICES * count;
}

static void make_ground(Vertex quad[QUAD_CORNERS], int width, int lines)
{
    const float right = (float)(width + 2 * MARGIN);
    const float bottom = (float)(lines * LINE_HEIGHT + 2 * MARGIN);
    const float corners[QUAD_CORNERS][2] = {{0, 0}, {right, 0}, {right, bottom}, {0, bottom}};
    for (int i = 0; i < QUAD_CORNERS; i++)
        quad[i] = (Vertex){corners[i][0], corners[i][1], 0, {16, 16, 24, 176}};
}

static void draw_vertices(const TextView *view, const Vertex *vertices, size_t count)
{
    glBindVertexArray(view->array);
    glBindBuffer(GL_ARRAY_BUFFER, view->vertices);
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(count * sizeof *vertices), vertices, GL_STREAM_DRAW);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glDrawArrays(GL_TRIANGLES, 0, (GLsizei)count);
    glDisable(GL_BLEND);
    glBindVertexArray(0);
}

void text_view_draw(const TextView *view, const char *text, uint32_t width, uint32_t height,
                    uint32_t scale)
{
    char lines[TEXT_SIZE];
    unsigned char white[4] = {255, 255, 255, 255};
    Vertex *quads = malloc(QUAD_CORNERS * QUADS_MAX * sizeof(Vertex));
    Vertex *triangles = malloc(QUAD_VERTICES * QUADS_MAX * sizeof(Vertex));
    if (quads != NULL && triangles != NULL) {
        copy_printable(lines, text);
        break_lines(lines, (int)(width / scale) - 2 * MARGIN);
        make_ground(quads, stb_easy_font_width(lines), count_lines(lines));
        const int room = (int)((QUADS_MAX - 1) * QUAD_CORNERS * sizeof(Vertex));
        const int count =
            stb_easy_font_print(MARGIN, MARGIN + 2, lines, white, quads + QUAD_CORNERS, room);
        glUseProgram(view->program);
        glUniform2f(glGetUniformLocation(view->program, "size"), (float)width, (float)height);
        draw_vertices(view, triangles, make_triangles(triangles, quads, (size_t)count + 1, scale));
    }
    free(quads);
    free(triangles);
}
