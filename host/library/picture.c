// SPDX-License-Identifier: MIT
// Renderer, scene and the caller's settings -> the caller's floats, written tile by tile.
#include "library/handles.h"

// The side of a tile in pixels, which does not affect the picture.
#define TILE 128

// Copies the caller's settings into wanted, fills in defaults and checks the numbers.
static bool take_settings(ClrtPicture *wanted, const ClrtPicture *picture, const Scene *scene,
                          ClrtError *error)
{
    if (!check_struct(error, "the picture", picture, wanted, sizeof *wanted))
        return false;
    if (wanted->samples == 0)
        wanted->samples = 1;
    if (wanted->view == 0)
        wanted->view = 1;
    if (wanted->max_level == 0)
        wanted->max_level = scene->max_level;
    return check_number(error, "the width", wanted->width, 1, PICTURE_SIZE_MAX) &&
           check_number(error, "the height", wanted->height, 1, PICTURE_SIZE_MAX) &&
           check_number(error, "the number of samples", wanted->samples, 1, SAMPLES_MAX) &&
           check_number(error, "max_level", wanted->max_level, 0, MAX_LEVEL_LIMIT);
}

static bool take_viewpoint(Viewpoint *viewpoint, const ClrtPicture *wanted, const Scene *scene,
                           ClrtError *error)
{
    const size_t count = scene->viewpoints.count;
    if (wanted->camera != NULL)
        return scene_handle_take_camera(viewpoint, wanted->camera, error);
    if (wanted->view > count)
        return check_fail(error, CLRT_ARGUMENT, "view %u does not exist: the scene has %zu",
                          wanted->view, count);
    *viewpoint = scene->viewpoints.data[wanted->view - 1];
    return true;
}

// Fails if the caller's camera is too far from the scene. The scene's own cameras have been
// checked.
static bool check_distance(const ClrtRenderer *renderer, Viewpoint *viewpoint, ClrtError *error)
{
    Error cause = {0};
    const Scene alone = {.viewpoints = {.data = viewpoint, .count = 1}};
    return normalization_check(&renderer->session.scene.normalization, &alone, &cause) ||
           check_fail_for(error, CLRT_ARGUMENT, &cause);
}

static bool report_progress(void *context, const RenderProgress *progress)
{
    const ClrtPicture *wanted = context;
    return wanted->progress == NULL ||
           wanted->progress(wanted->user, progress->tiles_done, progress->tiles);
}

static bool draw(ClrtRenderer *renderer, const Viewpoint *viewpoint, ClrtPicture *wanted,
                 float *rgb, ClrtError *error)
{
    Error cause = {0};
    PictureResult drawn = {0};
    Framebuffer framebuffer = {(float(*)[3])rgb, wanted->width, wanted->height};
    const RenderObserver observer = {report_progress, wanted};
    const SessionPicture request = {.settings = {.width = wanted->width,
                                                 .height = wanted->height,
                                                 .samples = wanted->samples,
                                                 .max_level = wanted->max_level,
                                                 .tile_width = TILE,
                                                 .tile_height = TILE},
                                    .viewpoint = *viewpoint};
    if (!session_draw(&renderer->session, &request, &observer, &framebuffer, &drawn, &cause))
        return check_fail_for(error, CLRT_DEVICE, &cause);
    return drawn.is_complete ||
           check_fail(error, CLRT_STOPPED, "the picture was stopped after %llu of %llu tiles",
                      (unsigned long long)drawn.progress.tiles_done,
                      (unsigned long long)drawn.progress.tiles);
}

static bool render(ClrtRenderer *renderer, const ClrtScene *scene, const ClrtPicture *picture,
                   float *rgb, ClrtError *error)
{
    ClrtPicture wanted;
    Viewpoint viewpoint;
    return take_settings(&wanted, picture, &scene->scene, error) &&
           take_viewpoint(&viewpoint, &wanted, &scene->scene, error) &&
           renderer_handle_take(renderer, scene, error) &&
           check_distance(renderer, &viewpoint, error) &&
           draw(renderer, &viewpoint, &wanted, rgb, error);
}

bool clrt_render(ClrtRenderer *renderer, const ClrtScene *scene, const ClrtPicture *picture,
                 float *rgb, ClrtError *error)
{
    if (!check_given(error, "the renderer", renderer) || !check_given(error, "the scene", scene) ||
        !check_given(error, "the picture's memory", rgb))
        return false;
    if (atomic_exchange(&renderer->is_busy, true))
        return check_fail(error, CLRT_ARGUMENT, "the renderer is drawing another picture");
    const bool ok = render(renderer, scene, picture, rgb, error);
    atomic_store(&renderer->is_busy, false);
    return ok;
}
