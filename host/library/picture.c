// SPDX-License-Identifier: MIT
// Implements clrt_render and clrt_reference. The session draws pictures directly into the caller's
// pixels. References, channels and results are copied to the caller.
#include "library/drawing.h"

#include "base/clock.h"
#include "session/level.h"
#include "session/reference.h"

#include <string.h>

// Draws the colors and, if a channel requires it, computes the certainty of the pixels.
static bool draw_colors(Drawing *drawing, ClrtError *error)
{
    Error cause = {0};
    const RenderObserver observer = {drawing_continues, drawing};
    if (session_scene_own_form(&drawing->renderer->session, &cause) == NULL)
        return library_fail_for(error, CLRT_SCENE, &cause);
    Session *session = &drawing->renderer->session;
    SessionPicture *request = &drawing->request;
    return (session_choose_level(session, request, &cause) &&
            session_draw_picture(session, request, &observer, &drawing->framebuffer,
                                 &drawing->drawn, &cause) &&
            (drawing->is_stopped ||
             session_certify_picture(session, request, &observer, &drawing->framebuffer,
                                     &drawing->drawn, &cause))) ||
           library_fail_for(error, CLRT_DEVICE, &cause);
}

// Copies the values of the channel in row `row` of aov_table to the caller. Returns the number of
// the channel's components.
static uint32_t copy_channel(const Drawing *drawing, const Layers *layers, size_t row,
                             uint32_t first)
{
    const uint32_t components = aov_channel_count(&aov_table[row]);
    const size_t pixels = (size_t)layers->width * layers->height;
    for (uint32_t i = 0; i < drawing->wanted.channel_count; i++) {
        const ClrtChannel *channel = &drawing->wanted.channels[i];
        uint32_t *values = channel->values;
        for (size_t pixel = 0; pixel < pixels && strcmp(channel->name, aov_table[row].name) == 0;
             pixel++)
            memcpy(values + pixel * components, layers->values + pixel * layers->count + first,
                   components * sizeof *values);
    }
    return components;
}

static bool draw_channels(Drawing *drawing, ClrtError *error)
{
    Error cause = {0};
    Layers layers = {0};
    const RenderObserver observer = {drawing_continues, drawing};
    if (drawing->is_stopped || drawing->channels == 0)
        return true;
    aov_name_layers(drawing->channels, &layers);
    const bool ok =
        layers_make(&layers, drawing->framebuffer.width, drawing->framebuffer.height, &cause) &&
        session_draw_channels(&drawing->renderer->session, &drawing->request, &observer, &layers,
                              &drawing->drawn, &cause);
    uint32_t first = 0;
    for (size_t row = 0; ok && !drawing->is_stopped && row < aov_count; row++)
        if ((drawing->channels >> row & 1) != 0)
            first += copy_channel(drawing, &layers, row, first);
    layers_free(&layers);
    return ok || library_fail_for(error, CLRT_DEVICE, &cause);
}

static bool check_stopped(const Drawing *drawing, ClrtError *error)
{
    return !drawing->is_stopped ||
           library_fail(error, CLRT_STOPPED, "the picture was stopped after %llu of %llu tiles",
                        (unsigned long long)drawing->tiles_done,
                        (unsigned long long)drawing->tiles);
}

static bool draw(Drawing *drawing, ClrtError *error)
{
    const double start = clock_seconds();
    const bool ok = draw_colors(drawing, error) && draw_channels(drawing, error) &&
                    check_stopped(drawing, error);
    drawing->seconds = clock_seconds() - start;
    return ok;
}

static bool draw_reference(Drawing *drawing, ClrtError *error)
{
    Error cause = {0};
    ReferencePicture reference;
    const double start = clock_seconds();
    const RenderObserver observer = {drawing_continues, drawing};
    const Framebuffer *frame = &drawing->framebuffer;
    if (drawing->channels != 0)
        return library_fail(error, CLRT_ARGUMENT, "a reference has no channels");
    const bool ok = reference_draw(&drawing->renderer->session, &drawing->request, &observer,
                                   &reference, &cause) ||
                    library_fail_for(error, CLRT_DEVICE, &cause);
    if (ok && !drawing->is_stopped)
        memcpy(frame->pixels, reference.picture.pixels,
               (size_t)frame->width * frame->height * sizeof *frame->pixels);
    SessionPicture *request = &drawing->request;
    request->settings.max_level = request->reference_level;
    drawing->drawn.facts.error = reference.own_error;
    drawing->drawn.facts.truncation = truncation_bound(drawing->scene, request->reference_level);
    drawing->drawn.facts.sample_count =
        (uint64_t)frame->width * frame->height * request->reference_samples;
    drawing->seconds = clock_seconds() - start;
    framebuffer_free(&reference.picture);
    return ok && check_stopped(drawing, error);
}

static void fill_result(const Drawing *drawing)
{
    const RenderSettings *settings = &drawing->request.settings;
    const PictureResult *drawn = &drawing->drawn;
    const uint64_t *tallies = drawn->progress.tallies, *marks = drawn->certainty.counts;
    ClrtResult filled = drawn->facts;
    filled.width = settings->width;
    filled.height = settings->height;
    filled.samples = settings->samples;
    filled.max_level = settings->max_level;
    filled.pixels_open = marks[CERTAINTY_OPEN];
    filled.pixels_repaired = marks[CERTAINTY_REPAIRED];
    filled.pixels_certified = marks[CERTAINTY_CERTIFIED];
    filled.seconds = drawing->seconds;
    filled.camera_rays = tallies[TALLY_CAMERA_RAYS];
    filled.shadow_rays = tallies[TALLY_SHADOW_RAYS];
    filled.reflected_rays = tallies[TALLY_REFLECTED_RAYS];
    filled.camera_hits = tallies[TALLY_CAMERA_HITS];
    filled.shaded_points = tallies[TALLY_SHADED_POINTS];
    filled.triangle_tests = tallies[TALLY_TRIANGLE_TESTS];
    filled.box_tests = tallies[TALLY_BOX_TESTS];
    filled.sphere_tests = tallies[TALLY_SPHERE_TESTS];
    if (drawing->wanted.result != NULL)
        argument_fill(NULL, "the result", drawing->wanted.result, &filled, sizeof filled);
}

// Prepares the request, calls `perform`, and fills the caller's result.
static bool perform_drawing(Drawing *drawing, const ClrtPicture *picture, float *rgb,
                            bool perform(Drawing *, ClrtError *), ClrtError *error)
{
    if (!argument_given(error, "the picture's memory", rgb) ||
        !drawing_begin(drawing, picture, error))
        return false;
    drawing->framebuffer = (Framebuffer){(float(*)[3])rgb, drawing->request.settings.width,
                                         drawing->request.settings.height};
    const bool ok = drawing_take_scene(drawing, error) && perform(drawing, error);
    if (ok)
        fill_result(drawing);
    picture_result_free(&drawing->drawn);
    drawing_end(drawing);
    return ok;
}

bool clrt_render(ClrtRenderer *renderer, const ClrtScene *scene, const ClrtPicture *picture,
                 float *rgb, ClrtError *error)
{
    Drawing drawing = {.renderer = renderer, .handle = scene};
    return perform_drawing(&drawing, picture, rgb, draw, error);
}

bool clrt_reference(ClrtRenderer *renderer, const ClrtScene *scene, const ClrtPicture *picture,
                    float *rgb, ClrtError *error)
{
    Drawing drawing = {.renderer = renderer, .handle = scene};
    return perform_drawing(&drawing, picture, rgb, draw_reference, error);
}

void clrt_hash(const float *rgb, uint32_t width, uint32_t height, char hash[33])
{
    const Framebuffer framebuffer = {(float(*)[3])rgb, width, height};
    framebuffer_hash(&framebuffer, hash);
}
