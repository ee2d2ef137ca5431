// SPDX-License-Identifier: MIT
// Draws text by a texture of characters, which stb_truetype makes from an installed font. The
// layout is repeated with smaller fonts until the text fits the window or the font is below
// SMALLEST.
#define STB_TRUETYPE_IMPLEMENTATION
#include "view/draw/text_view.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SIZE         17.0f // of the font in pixels, from ascent to descent, at density 1
#define SMALLEST     8.0f
#define SHRINKING    0.94f
#define LINE_STEP    1.2f // this and the sizes below are multiples of the font's size
#define BASELINE     0.9f
#define MARGIN       0.4f
#define GAP          1.2f // between columns
#define TEXTURE_SIDE 14   // a texture of this width and height holds all characters
#define FOLDER       "/usr/share/fonts/truetype/"

// The fonts, in the order in which clrt tries them. Fixed paths avoid a dependency on fontconfig.
// tools/setup installs the first font.
static const char *const font_paths[] = {
    FOLDER "dejavu/DejaVuSans.ttf", FOLDER "liberation/LiberationSans-Regular.ttf",
    FOLDER "noto/NotoSans-Regular.ttf", FOLDER "freefont/FreeSans.ttf"};

static const float ground[4] = {0.055f, 0.063f, 0.094f, 0.78f}, plain[4] = {1, 1, 1, 1},
                   marked[4] = {1, 0.816f, 0.47f, 1};

static bool open_font(Font *font, const char *path)
{
    Error cause = {0};
    stbtt_fontinfo info;
    if (!file_read(&font->file, path, &cause))
        return false;
    if (!stbtt_InitFont(&info, (unsigned char *)font->file.bytes, 0)) {
        file_free(&font->file);
        return false;
    }
    for (int i = 0; i < FONT_CHARACTERS; i++) {
        int advance, bearing;
        stbtt_GetCodepointHMetrics(&info, ' ' + i, &advance, &bearing);
        font->advances[i] = stbtt_ScaleForPixelHeight(&info, 1) * (float)advance;
    }
    return true;
}

static bool find_font(Font *font, Error *error)
{
    for (size_t i = 0; i < sizeof font_paths / sizeof *font_paths; i++)
        if (open_font(font, font_paths[i]))
            return true;
    return error_set(error, "no font is found, so the window shows no text: install the package "
                            "fonts-dejavu-core");
}

static void set_size(Font *font, float size)
{
    Error error = {0};
    const int side = TEXTURE_SIDE * (int)ceilf(size);
    unsigned char *texels = memory_zeroed((size_t)side * (size_t)side, 1, &error);
    if (texels == NULL)
        return;
    stbtt_BakeFontBitmap((unsigned char *)font->file.bytes, 0, size, texels, side, side, ' ',
                         FONT_CHARACTERS, font->glyphs);
    texels[0] = 255;
    glBindTexture(GL_TEXTURE_2D, font->texture);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, side, side, 0, GL_RED, GL_UNSIGNED_BYTE, texels);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    free(texels);
    font->side = side;
    font->size = size;
}

// Returns a character's number in the font. A question mark replaces unknown characters.
static int number_of(char character)
{
    return (character >= ' ' && character <= '~' ? character : '?') - ' ';
}

static float width_of(const Font *font, const char *text, size_t length)
{
    float width = 0;
    for (size_t i = 0; i < length; i++)
        width += font->advances[number_of(text[i])];
    return width;
}

bool text_view_open(TextView *view, Error *no_font, Error *error)
{
    static const DrawingLayout layout = {
        shader_text, true, {{"first", 4}, {"last", 4}, {"tint", 4}}};
    *view = (TextView){0};
    find_font(&view->font, no_font);
    glGenTextures(1, &view->font.texture);
    return drawing_open(&view->drawing, &layout, error);
}

void text_view_close(TextView *view)
{
    drawing_close(&view->drawing);
    glDeleteTextures(1, &view->font.texture);
    file_free(&view->font.file);
    free(view->quads.memory);
    *view = (TextView){0};
}

// Adds a character's rectangle to view->quads. If memory runs out, the character is not drawn.
static void add_quad(TextView *view, const stbtt_aligned_quad *place, const float color[4])
{
    Error error = {0};
    const TextQuad quad = {*place, {color[0], color[1], color[2], color[3]}};
    (void)array_push(&view->quads, quad, &error);
}

// The position and style of the next character.
typedef struct {
    TextView *view;
    float size;   // of the font, in pixels
    float x, y;   // of the next character's upper left corner
    float right;  // the right end of lines
    float widest; // the largest x so far
    bool draws;   // false: only measures characters
    const float *color;
} Pen;

static void put_characters(Pen *pen, const char *text, size_t length)
{
    const Font *font = &pen->view->font;
    for (size_t i = 0; i < length; i++) {
        stbtt_aligned_quad quad;
        const int number = number_of(text[i]);
        float x = pen->x, y = pen->y + BASELINE * pen->size;
        pen->x += font->advances[number] * pen->size;
        if (!pen->draws)
            continue;
        stbtt_GetBakedQuad(font->glyphs, font->side, font->side, number, &x, &y, &quad, 1);
        add_quad(pen->view, &quad, pen->color);
    }
    pen->widest = fmaxf(pen->widest, pen->x);
}

// Adds the words up to `end`. A word that does not fit starts a new line below the first word.
static void put_words(Pen *pen, const char *text, const char *end)
{
    const float left = pen->x;
    while (text < end) {
        const size_t blanks = strspn(text, " "), word = blanks + strcspn(text + blanks, " \n");
        size_t skipped = 0;
        if (pen->x > left &&
            pen->x + width_of(&pen->view->font, text, word) * pen->size > pen->right) {
            pen->x = left;
            pen->y += LINE_STEP * pen->size;
            skipped = blanks;
        }
        put_characters(pen, text + skipped, word - skipped);
        text += word;
    }
}

// Returns the end of the line's first column, which is before two blanks or at the end of the line.
static const char *column_end(const char *line)
{
    const char *end = line + strcspn(line, "\n"), *gap = strstr(line + strspn(line, " "), "  ");
    return gap != NULL && gap < end ? gap : end;
}

// Returns the width of the first column and the gap after it, at font size 1. Returns 0 if there is
// only one column.
static float column_width(const Font *font, const char *text)
{
    float widest = 0;
    for (; *text != '\0'; text += strcspn(text, "\n"), text += *text == '\n') {
        const char *end = column_end(text);
        if (*end == ' ')
            widest = fmaxf(widest, width_of(font, text, (size_t)(end - text)) + GAP);
    }
    return widest;
}

static void put_text(Pen *pen, const char *text)
{
    const float left = pen->x;
    const float column = left + column_width(&pen->view->font, text) * pen->size;
    while (*text != '\0') {
        const char *gap = column_end(text), *end = text + strcspn(text, "\n");
        pen->x = left;
        pen->color = gap == end ? plain : marked;
        put_words(pen, text, gap);
        pen->x = column;
        pen->color = plain;
        put_words(pen, gap + strspn(gap, " "), end);
        pen->y += LINE_STEP * pen->size;
        text = end + (*end == '\n');
    }
    pen->y += MARGIN / 2 * pen->size;
}

static void draw_quads(TextView *view)
{
    drawing_use(&view->drawing);
    drawing_fill(&view->drawing, 0, view->quads.data, view->quads.count * sizeof(TextQuad));
    glBindTexture(GL_TEXTURE_2D, view->font.texture);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, (GLsizei)view->quads.count);
    glDisable(GL_BLEND);
    glBindVertexArray(0);
}

static float draw_text(TextView *view, const char *text, const TextOverlay *overlay, float top)
{
    Pen pen, start = {.view = view, .size = SIZE * overlay->density};
    for (;; start.size *= SHRINKING) {
        start.x = MARGIN * start.size;
        start.y = top + MARGIN / 2 * start.size;
        start.right = (float)overlay->width - start.x;
        pen = start;
        put_text(&pen, text);
        if ((pen.y <= (float)overlay->height && pen.widest <= start.right) || pen.size < SMALLEST)
            break;
    }
    if (view->font.size != pen.size)
        set_size(&view->font, pen.size);
    const float texel = 0.5f / (float)view->font.side;
    view->quads.count = 0;
    add_quad(view,
             &(stbtt_aligned_quad){0, top, texel, texel, pen.widest + start.x, pen.y, texel, texel},
             ground);
    start.draws = true;
    put_text(&start, text);
    draw_quads(view);
    return pen.y;
}

// Shortens the text until its width at font size 1 is at most `width`. First removes phrases at the
// end, each with the comma before it. If no comma is left, removes single characters and ends the
// text with dots.
static void shorten(const Font *font, char *text, float width)
{
    static const char dots[] = "...";
    while (text[0] != '\0' && width_of(font, text, strlen(text)) > width) {
        const size_t length = strlen(text);
        char *comma = strrchr(text, ',');
        if (comma != NULL)
            *comma = '\0';
        else if (length > sizeof dots)
            memcpy(text + length - sizeof dots, dots, sizeof dots);
        else
            text[0] = '\0';
    }
}

void text_view_draw(TextView *view, const TextOverlay *overlay)
{
    float top = 0;
    if (view->font.file.bytes == NULL)
        return;
    glUseProgram(view->drawing.program);
    glUniform2f(glGetUniformLocation(view->drawing.program, "size"), (float)overlay->width,
                (float)overlay->height);
    shorten(&view->font, overlay->line,
            (float)overlay->width / (SIZE * overlay->density) - 2 * MARGIN);
    if (overlay->line[0] != '\0')
        top = draw_text(view, overlay->line, overlay, 0);
    if (overlay->panel[0] != '\0')
        draw_text(view, overlay->panel, overlay, top);
}
