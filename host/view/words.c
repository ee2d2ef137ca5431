// SPDX-License-Identifier: MIT
// Nothing here asks the time or the system, so the same state always reads the same.
#include "view/words.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdlib.h>

// A text that grows at its end; what does not fit is cut off.
typedef struct {
    char *text;
    size_t size, length;
} Words;

static Words words_of(char *text, size_t size)
{
    text[0] = '\0';
    return (Words){text, size, 0};
}

__attribute__((format(printf, 2, 3))) static void add(Words *words, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const int length =
        vsnprintf(words->text + words->length, words->size - words->length, format, arguments);
    va_end(arguments);
    const size_t room = words->size - 1 - words->length;
    words->length += length > 0 && (size_t)length < room ? (size_t)length : length > 0 ? room : 0;
}

static const char *view_name(const State *state)
{
    return state->traced ? "ray traced" : "OpenGL";
}

static const char *on_or_off(bool on)
{
    return on ? "on" : "off";
}

static void add_boxes(Words *words, const State *state, const Figures *figures)
{
    if (!state->boxes)
        return;
    if (state->level == 0)
        add(words, ", boxes of leaves: %u", figures->box_count);
    else
        add(words, ", boxes at level %u: %u", state->level, figures->box_count);
}

static void add_state(Words *words, const State *state, const Figures *figures)
{
    add(words, "%s, view %u%s", view_name(state), state->view, state->moved ? " moved" : "");
    if (state->smooth)
        add(words, ", AA %ux%u", figures->samples, figures->samples);
    else
        add(words, ", AA off");
    add(words, ", BVH %s", on_or_off(state->uses_bvh));
    add_boxes(words, state, figures);
    if (state->normals)
        add(words, ", normals");
    if (state->turning)
        add(words, ", turning");
    if (state->exposure != 0)
        add(words, ", exposure %+.1f", state->exposure / 2.0);
}

static void add_orbit(Words *words, const Orbit *orbit)
{
    add(words, "azimuth %.2f, rotation %.2f, distance %.3g", orbit->azimuth, orbit->rotation,
        orbit->distance);
}

void words_state(char *text, size_t size, const State *state, const Figures *figures)
{
    Words words = words_of(text, size);
    add_state(&words, state, figures);
    add(&words, ", help %s, text %s, ", on_or_off(state->help), on_or_off(state->text));
    add_orbit(&words, &state->orbit);
    add(&words, ", %ux%u", figures->width, figures->height);
}

void words_overlay(char *text, size_t size, const State *state, const Figures *figures)
{
    Words words = words_of(text, size);
    add_state(&words, state, figures);
    add(&words, ", ");
    add_orbit(&words, &state->orbit);
    if (figures->frame_seconds > 0)
        add(&words, ", %.1f ms", 1e3 * figures->frame_seconds);
    if (state->traced && figures->divisor > 1)
        add(&words, " at 1/%u", figures->divisor);
    if (state->traced && figures->has_counts)
        add(&words, ", %" PRIu64 " rays, %.2f triangle tests a ray", figures->rays,
            figures->tests_per_ray);
    if (figures->busy[0] != '\0')
        add(&words, "\n%s", figures->busy);
    if (figures->notice[0] != '\0')
        add(&words, "\n%s", figures->notice);
    if (figures->failure[0] != '\0')
        add(&words, "\n%s", figures->failure);
    if (state->help)
        add(&words, "\n\n%s", words_help());
}

void words_title(char *text, size_t size, const State *state, const Figures *figures)
{
    Words words = words_of(text, size);
    add(&words, "%s - %s - clrt", figures->scene_name, view_name(state));
    if (figures->busy[0] != '\0')
        add(&words, " - %s", figures->busy);
    else if (state->traced && !figures->is_finished)
        add(&words, " - %.0f %%", 100 * figures->progress);
}

// The shortest form that is read back as the same number.
static void add_number(Words *words, const char *before, double value)
{
    char text[32];
    int digits = 6;
    do
        snprintf(text, sizeof text, "%.*g", digits++, value);
    while (digits <= 17 && strtod(text, NULL) != value);
    add(words, "%s%s", before, text);
}

static void add_vector(Words *words, const char *before, Vec3 v)
{
    add_number(words, before, v.x);
    add_number(words, " ", v.y);
    add_number(words, " ", v.z);
}

void words_camera(char *text, size_t size, const State *state)
{
    const Viewpoint *camera = &state->camera;
    Words words = words_of(text, size);
    add_orbit(&words, &state->orbit);
    if (camera->up.x != 0 || camera->up.y != 0 || camera->up.z != 1)
        add_vector(&words, "\nup ", camera->up);
    add_vector(&words, "\ncamera ", camera->eye);
    add_vector(&words, "  ", camera->look_at);
    add_number(&words, "  ", camera->fov_degrees);
    add(&words, "\n");
}

const char *words_help(void)
{
    return "r  OpenGL or ray traced\n"
           "1-9  the scene's cameras\n"
           "left drag, arrows  turn\n"
           "right drag, wheel  come nearer\n"
           "middle or Shift drag  move sideways\n"
           "o  turn by itself\n"
           "a  anti-aliasing\n"
           "b  tree or brute force\n"
           "B  boxes of the tree's leaves\n"
           "] [  boxes of inner nodes, deeper and back\n"
           "n  normals\n"
           "+ -  exposure\n"
           "a file dropped here  the scene shown instead\n"
           "c  print the camera\n"
           "s  save the picture\n"
           "R  read everything again\n"
           "t  text on and off\n"
           "h  this help\n"
           "q, Esc  quit";
}
