// SPDX-License-Identifier: MIT
// Each pass draws one sample per pixel with the ordinary kernels. For each pass, the camera shifts
// by a fraction of a pixel. The shifts follow Roberts's R2 sequence, an additive recurrence by
// powers of the plastic number. No shift lies on the N x N grid of --aa.
//
// Even and odd passes form two pictures, whose shifts start at different points. The reference is
// the mean of the two pictures, and their difference measures its error.
//
// The reference has the accuracy of fp64, but most passes are drawn in fp32, which is 6 to 9 times
// faster. Some passes are drawn in both precisions. The mean difference between the precisions is
// added to the mean of all fp32 passes. The sum's expected value is the picture in fp64 (Giles,
// Multilevel Monte Carlo Path Simulation, 2008). Few passes in fp64 suffice, because nearly all
// samples have the same color in both precisions.
#include "session/reference.h"

#include "render/tile_pass.h"
#include "scene/camera.h"

#include <math.h>
#include <stdlib.h>

#define ACROSS 0.7548776662466927
#define DOWN   0.5698402909980532

// About one in EXACT_STEP passes, and at least two passes, are also drawn in fp64.
#define EXACT_STEP 16

typedef struct {
    Renderer fast, exact; // fp32 and fp64
    CameraData camera;    // the requested camera, for one sample per pixel
    const RenderObserver *observer;
    Framebuffer pass;              // picture of the latest pass
    double (*halves[2])[3];        // pictures of the even passes and of the odd passes
    uint32_t passes, exact_passes; // even numbers, at least 2
    uint32_t passes_done;
    uint32_t draws_done; // fp32 passes plus fp64 passes
    bool stopped;
} Reference;

static const double starts[2][2] = {{0.1327, 0.6180}, {0.8241, 0.2936}};

static double part(double value)
{
    return value - floor(value);
}

static bool open_renderer(Renderer *renderer, Session *session, const RenderSettings *settings,
                          ClrtPrecision precision, Error *error)
{
    const KernelChoice choice =
        kernel_choice_make(&(ClrtSettings){.precision = precision}, &session->device);
    const RendererUse use = {.entry = &draw_entry, .choice = &choice};
    return kernel_choice_check_device(&choice, &session->device, error) &&
           session_renderer(session, &use, settings, renderer, error);
}

// Reports the progress of all passes together.
static bool tile_done(void *context, const RenderProgress *progress)
{
    Reference *reference = context;
    const uint32_t draws = reference->passes + reference->exact_passes;
    const RenderProgress whole = {.tiles_done = reference->draws_done * progress->tiles +
                                                progress->tiles_done,
                                  .tiles = draws * progress->tiles};
    reference->stopped = !render_observer_continues(reference->observer, &whole);
    return !reference->stopped;
}

// Draws a pass, multiplies its colors by `weight`, and adds them to the even or the odd picture.
static bool add_pass(Reference *reference, Renderer *renderer, double weight, Error *error)
{
    CameraData camera = reference->camera;
    const uint32_t half = reference->passes_done % 2;
    const double place = reference->passes_done / 2; // the index of the pass in its picture
    camera_shift(&camera, part(starts[half][0] + place * ACROSS) - 0.5,
                 part(starts[half][1] + place * DOWN) - 0.5);
    const RenderObserver observer = {tile_done, reference};
    if (!tile_pass_draw(renderer, &camera, &observer, &reference->pass, error))
        return false;
    reference->draws_done++;
    const size_t pixels = (size_t)reference->pass.width * reference->pass.height;
    for (size_t pixel = 0; pixel < pixels; pixel++)
        for (int color = 0; color < 3; color++)
            reference->halves[half][pixel][color] +=
                weight * (double)reference->pass.pixels[pixel][color];
    return true;
}

static bool draw_pass(Reference *reference, Error *error)
{
    const bool is_exact = reference->passes_done < reference->exact_passes;
    const double exact = is_exact ? 2.0 / reference->exact_passes : 0;
    const double fast = 2.0 / reference->passes - exact;
    return add_pass(reference, &reference->fast, fast, error) &&
           (!is_exact || add_pass(reference, &reference->exact, exact, error));
}

static bool draw_passes(Reference *reference, Error *error)
{
    bool ok = true;
    while (ok && !reference->stopped && reference->passes_done < reference->passes) {
        ok = draw_pass(reference, error);
        reference->passes_done++;
    }
    return ok;
}

// Stores the mean of the even and the odd picture in *mean. Returns the mean's RMSE, estimated from
// the difference of the two pictures.
static double join_halves(const Reference *reference, Framebuffer *mean)
{
    const size_t pixels = (size_t)mean->width * mean->height;
    double squares = 0;
    for (size_t pixel = 0; pixel < pixels; pixel++)
        for (int color = 0; color < 3; color++) {
            const double one = reference->halves[0][pixel][color],
                         other = reference->halves[1][pixel][color];
            mean->pixels[pixel][color] = (float)((one + other) / 2);
            squares += (one - other) * (one - other) / 4;
        }
    return sqrt(squares / (3 * (double)pixels));
}

static bool open_reference(Reference *reference, Session *session, const SessionPicture *request,
                           Error *error)
{
    RenderSettings settings = request->settings;
    settings.samples = 1;
    settings.max_level = request->reference_level;
    settings.ready_tiles = 0;
    reference->camera = session_picture_camera(session, request, 1);
    const size_t pixels = (size_t)settings.width * settings.height;
    for (int half = 0; half < 2; half++) {
        reference->halves[half] = memory_zeroed(pixels, sizeof *reference->halves[half], error);
        if (reference->halves[half] == NULL)
            return false;
    }
    return open_renderer(&reference->fast, session, &settings, CLRT_FP32, error) &&
           open_renderer(&reference->exact, session, &settings, CLRT_FP64, error) &&
           framebuffer_make(&reference->pass, settings.width, settings.height, error);
}

bool reference_draw(Session *session, const SessionPicture *request, const RenderObserver *observer,
                    ReferencePicture *result, Error *error)
{
    const uint32_t samples = request->reference_samples;
    const uint32_t exact = 2 * (samples / 2 / EXACT_STEP) + 2;
    Reference reference = {
        .observer = observer, .passes = samples, .exact_passes = exact < samples ? exact : samples};
    *result = (ReferencePicture){0};
    bool ok = open_reference(&reference, session, request, error) && draw_passes(&reference, error);
    if (ok && !reference.stopped) {
        ok = framebuffer_make(&result->picture, reference.pass.width, reference.pass.height, error);
        if (ok)
            result->own_error = join_halves(&reference, &result->picture);
    }
    for (int half = 0; half < 2; half++)
        free(reference.halves[half]);
    framebuffer_free(&reference.pass);
    return ok;
}
