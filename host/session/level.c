// SPDX-License-Identifier: MIT
// Draws coarse pictures, each with one more level, until the rays that max_level cuts off have
// small weights (kernels/branches.cl). Each level multiplies the time of a picture by about 1.4.
//
// Invariant: the sums of the weights are integers, so the level does not depend on the kernels'
// form, on threads or on tiles.
#include "session/level.h"

#include "render/sampler.h"
#include "render/tile_pass.h"

#include <math.h>

// The largest number of pixels in the coarse picture, except for very narrow pictures.
#define COARSE_PIXELS 4096

// The smallest level, which is enough for a path through a ball. The coarse picture can miss small
// pieces of glass.
#define LEVEL_LEAST 3

// A single cut ray among COARSE_PIXELS pixels counts as at least this error, because squared errors
// are rounded up to multiples of 2^-32. If the bound is smaller, the picture has all levels, and
// clrt draws no coarse picture.
#define MEASURED_LEAST 0x1p-22

static RenderSettings coarse_settings(const RenderSettings *settings)
{
    const uint32_t width = render_whole_width(settings), height = render_whole_height(settings);
    const uint32_t step = (uint32_t)ceil(sqrt((double)width * height / COARSE_PIXELS));
    const uint32_t columns = width / step > 0 ? width / step : 1;
    const uint32_t rows = height / step > 0 ? height / step : 1;
    return (RenderSettings){
        .width = columns, .height = rows, .samples = 1, .tile_width = columns, .tile_height = rows};
}

// Draws the coarse picture. Stores a bound on the picture's error that is due to
// settings.max_level.
static bool measure(Renderer *renderer, const CameraData *camera, double *truncated, Error *error)
{
    Framebuffer colors;
    const uint32_t width = renderer->settings.width, height = renderer->settings.height;
    const bool is_ladder = renderer->kernel->entry == &ladder_entry;
    FrameData frame = renderer_frame(renderer, camera);
    frame.samples = LADDER_GRID;
    renderer->progress = (RenderProgress){0};
    const bool ok = framebuffer_make(&colors, width, height, error) &&
                    (is_ladder ? sampler_draw_centers(renderer, &frame, colors.pixels, NULL, error)
                               : tile_pass_draw(renderer, camera, NULL, &colors, error));
    framebuffer_free(&colors);
    *truncated = renderer_truncation(renderer, (uint64_t)width * height);
    return ok;
}

bool session_choose_level(Session *session, SessionPicture *request, Error *error)
{
    Renderer renderer;
    SessionPicture coarse = *request;
    const bool is_ladder = picture_entry(&request->wanted) == &ladder_entry;
    const RendererUse use = {.entry = is_ladder ? &ladder_entry : &draw_entry,
                             .counts = request->wanted.statistics};
    if (request->level_bound < MEASURED_LEAST)
        return true;
    if (!session_renderer(session, &use, &request->settings, &renderer, error))
        return false;
    renderer.settings = coarse.settings = coarse_settings(&request->settings);
    const CameraData camera = session_picture_camera(session, &coarse, is_ladder ? LADDER_GRID : 1);
    uint32_t *level = &renderer.settings.max_level;
    double truncated = INFINITY;
    for (*level = LEVEL_LEAST; *level < GLASS_LEVELS; ++*level) {
        if (!measure(&renderer, &camera, &truncated, error))
            return false;
        if (truncated <= request->level_bound)
            break;
    }
    request->settings.max_level = *level;
    return true;
}
