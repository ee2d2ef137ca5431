// SPDX-License-Identifier: MIT
// Writes the window's texts. A text depends only on the arguments, so callers can compare texts to
// detect changes.
#include "view/status_text.h"

#include "scene/scn_write.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdlib.h>

// A text that grows at its end and is truncated if it gets too long.
typedef struct {
    char *text;
    size_t size, length;
} Buffer;

static Buffer buffer_of(char *text, size_t size)
{
    text[0] = '\0';
    return (Buffer){text, size, 0};
}

__attribute__((format(printf, 2, 3))) static void add(Buffer *buffer, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const int length =
        vsnprintf(buffer->text + buffer->length, buffer->size - buffer->length, format, arguments);
    va_end(arguments);
    const size_t room = buffer->size - 1 - buffer->length;
    buffer->length += length > 0 && (size_t)length < room ? (size_t)length : length > 0 ? room : 0;
}

static const char *view_name(const State *state)
{
    return state->traced ? "ray traced" : "OpenGL";
}

static const char *on_or_off(bool on)
{
    return on ? "on" : "off";
}

static void add_boxes(Buffer *buffer, const State *state, const Figures *figures)
{
    if (!state->boxes)
        return;
    if (state->box_depth == 0)
        add(buffer, ", boxes of leaves: %u", figures->box_count);
    else
        add(buffer, ", boxes at level %u: %u", state->box_depth, figures->box_count);
}

static void add_state(Buffer *buffer, const State *state, const Figures *figures)
{
    add(buffer, "%s, view %u%s", view_name(state), state->view, state->moved ? " moved" : "");
    if (state->smooth)
        add(buffer, ", AA %ux%u", figures->samples, figures->samples);
    else
        add(buffer, ", AA off");
    add(buffer, ", BVH %s", on_or_off(state->uses_bvh));
    add_boxes(buffer, state, figures);
    if (state->normals)
        add(buffer, ", normals");
    if (state->turning)
        add(buffer, ", turning");
    if (state->full_screen)
        add(buffer, ", full screen");
    if (figures->up != NULL)
        add(buffer, ", up %s", figures->up);
    if (state->exposure != 0)
        add(buffer, ", exposure %+.1f", state->exposure / 2.0);
}

static void add_orbit(Buffer *buffer, const Orbit *orbit)
{
    add(buffer, "azimuth %.2f, rotation %.2f, distance %.3g", orbit->azimuth, orbit->rotation,
        orbit->distance);
}

void status_text_state(char *text, size_t size, const State *state, const Figures *figures)
{
    Buffer buffer = buffer_of(text, size);
    add_state(&buffer, state, figures);
    add(&buffer, ", help %s, text %s, ", on_or_off(state->help), on_or_off(state->text));
    add_orbit(&buffer, &state->orbit);
    add(&buffer, ", %ux%u", figures->width, figures->height);
}

static void add_message(Buffer *buffer, const char *message, const char *end)
{
    if (message[0] != '\0')
        add(buffer, "%s%s", message, end);
}

void status_text_line(char *text, size_t size, const State *state, const Figures *figures)
{
    Buffer buffer = buffer_of(text, size);
    add_message(&buffer, figures->busy, ", ");
    add_message(&buffer, figures->notice, ", ");
    add_message(&buffer, figures->hint, ", ");
    add_message(&buffer, figures->missing, ", ");
    add_state(&buffer, state, figures);
    if (figures->frame_seconds > 0)
        add(&buffer, ", %.1f ms", 1e3 * figures->frame_seconds);
    if (state->traced && figures->divisor > 1)
        add(&buffer, " at 1/%u", figures->divisor);
    if (state->traced && figures->has_counts)
        add(&buffer, ", %" PRIu64 " rays, %.2f triangle tests per ray", figures->rays,
            figures->tests_per_ray);
    add(&buffer, ", ");
    add_orbit(&buffer, &state->orbit);
}

void status_text_panel(char *text, size_t size, const State *state, const Figures *figures)
{
    Buffer buffer = buffer_of(text, size);
    if (state->text)
        add_message(&buffer, figures->failure, "\n");
    add_message(&buffer, figures->explanation, "");
    if (state->help)
        add(&buffer, "%s", status_text_help());
}

void status_text_title(char *text, size_t size, const State *state, const Figures *figures)
{
    Buffer buffer = buffer_of(text, size);
    add(&buffer, "%s - %s - clrt", figures->scene_name, view_name(state));
    if (figures->busy[0] != '\0')
        add(&buffer, " - %s", figures->busy);
    else if (state->traced && !figures->is_finished)
        add(&buffer, " - %.0f %%", 100 * figures->progress);
}

void status_text_camera(const State *state, FILE *stream)
{
    char text[256];
    Buffer buffer = buffer_of(text, sizeof text);
    add_orbit(&buffer, &state->orbit);
    fprintf(stream, "%s\n", text);
    scn_write_camera(&state->camera, vec3(0, 0, 1), stream);
}

const char *status_text_help(void)
{
    return "left drag, arrows  turn the camera\n"
           "middle or Shift drag  move the camera sideways\n"
           "right drag, wheel  move closer or away\n"
           "click  explain the pixel\n"
           "1-9  the scene's cameras\n"
           "r  rays or OpenGL\n"
           "a  anti-alias the resting picture or not\n"
           "+ -  exposure\n"
           "o  turn continuously\n"
           "u  another up axis of a mesh without a scene\n"
           "n  normals\n"
           "] [  boxes of the tree, a level deeper or back\n"
           "B  boxes of the tree's leaves\n"
           "b  trace with or without the tree\n"
           "c  print the camera\n"
           "s, F12, Ctrl-S  save the picture\n"
           "R  reload the scene and the kernels\n"
           "drop a file  show that scene\n"
           "t  show or hide the line at the top\n"
           "h, ?, F1  show or hide this help\n"
           "F11  full screen\n"
           "Esc  leave full screen, or quit\n"
           "q, Ctrl-Q  quit";
}
