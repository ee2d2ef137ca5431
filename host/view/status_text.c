// SPDX-License-Identifier: MIT
// Writes the window's texts. A text depends only on its Figures, so callers can compare texts to
// detect changes.
#include "view/status_text.h"

#include "scene/scn_write.h"

#include <inttypes.h>

static const char *view_name(const State *state)
{
    return state->traced ? "ray traced" : "OpenGL";
}

static const char *on_or_off(bool on)
{
    return on ? "on" : "off";
}

static void add_boxes(const Figures *figures, FILE *stream)
{
    const State *state = figures->state;
    if (!state->boxes)
        return;
    if (state->box_depth == 0)
        fprintf(stream, ", boxes of leaves: %u", figures->box_count);
    else
        fprintf(stream, ", boxes at level %u: %u", state->box_depth, figures->box_count);
}

static void add_state(const Figures *figures, FILE *stream)
{
    const State *state = figures->state;
    fprintf(stream, "%s, view %u%s", view_name(state), state->view, state->moved ? " moved" : "");
    if (state->camera.height > 0)
        fprintf(stream, ", orthographic, height %.3g", state->camera.height);
    if (state->smooth)
        fprintf(stream, ", AA %ux%u", figures->samples, figures->samples);
    else
        fprintf(stream, ", AA off");
    fprintf(stream, ", BVH %s", on_or_off(state->uses_bvh));
    add_boxes(figures, stream);
    if (state->normals)
        fprintf(stream, ", normals");
    if (state->turning)
        fprintf(stream, ", turning");
    if (state->full_screen)
        fprintf(stream, ", full screen");
    if (figures->up != NULL)
        fprintf(stream, ", up %s", figures->up);
    if (state->exposure != 0)
        fprintf(stream, ", exposure %+.1f", state->exposure / 2.0);
}

static void add_orbit(const Orbit *orbit, FILE *stream)
{
    fprintf(stream, "azimuth %.2f, rotation %.2f, distance %.3g", orbit->azimuth, orbit->rotation,
            orbit->distance);
}

void status_text_state(const Figures *figures, FILE *stream)
{
    const State *state = figures->state;
    add_state(figures, stream);
    fprintf(stream, ", help %s, text %s, ", on_or_off(state->help), on_or_off(state->text));
    add_orbit(&state->orbit, stream);
    fprintf(stream, ", %ux%u", figures->request->width, figures->request->height);
}

static void add_message(const char *message, const char *end, FILE *stream)
{
    if (message[0] != '\0')
        fprintf(stream, "%s%s", message, end);
}

static void add_counts(const WorkerStatus *status, FILE *stream)
{
    const uint64_t *tallies = status->tallies;
    const uint64_t rays =
        tallies[TALLY_CAMERA_RAYS] + tallies[TALLY_SHADOW_RAYS] + tallies[TALLY_REFLECTED_RAYS];
    if (status->failure.text[0] == '\0')
        fprintf(stream, ", %" PRIu64 " rays, %.2f triangle tests per ray", rays,
                rays > 0 ? (double)tallies[TALLY_TRIANGLE_TESTS] / (double)rays : 0);
}

void status_text_line(const Figures *figures, FILE *stream)
{
    const State *state = figures->state;
    add_message(figures->status->busy, ", ", stream);
    add_message(figures->notice, ", ", stream);
    add_message(figures->hint, ", ", stream);
    add_message(figures->missing, ", ", stream);
    add_state(figures, stream);
    if (figures->status->frame_seconds > 0)
        fprintf(stream, ", %.1f ms", 1e3 * figures->status->frame_seconds);
    if (state->traced && figures->status->reached.divisor > 1)
        fprintf(stream, " at 1/%u", figures->status->reached.divisor);
    if (state->traced && figures->status->reached.is_counted)
        add_counts(figures->status, stream);
    fprintf(stream, ", ");
    add_orbit(&state->orbit, stream);
}

void status_text_panel(const Figures *figures, FILE *stream)
{
    const State *state = figures->state;
    if (state->text)
        add_message(figures->failure, "\n", stream);
    add_message(figures->explanation, "", stream);
    if (state->help)
        controls_write_help(stream);
}

void status_text_title(const Figures *figures, FILE *stream)
{
    const State *state = figures->state;
    fprintf(stream, "%s - %s - clrt", figures->scene_name, view_name(state));
    if (figures->status->busy[0] != '\0')
        fprintf(stream, " - %s", figures->status->busy);
    else if (state->traced && !worker_is_finished(figures->status, figures->request))
        fprintf(stream, " - %.0f %%", 100 * figures->status->progress);
}

void status_text_camera(const State *state, FILE *stream)
{
    add_orbit(&state->orbit, stream);
    fputs("\n", stream);
    scn_write_camera(&state->camera, vec3(0, 0, 1), stream);
}

void status_text_store(StatusText *write, const Figures *figures, char *text, size_t size)
{
    FILE *stream = fmemopen(text, size, "w");
    text[0] = '\0';
    if (stream == NULL)
        return;
    write(figures, stream);
    fclose(stream);
    text[size - 1] = '\0';
}
