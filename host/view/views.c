// SPDX-License-Identifier: MIT
// Draws a frame by OpenGL. Surfaces hide the lines behind them, also in the ray-traced view. If
// there are lines, OpenGL therefore draws the scene first. The traced picture then replaces the
// colors, but not the depth.
#include "view/views.h"

static const float blue[3] = {26 / 255.0f, 77 / 255.0f, 1}, red[3] = {1, 26 / 255.0f, 13 / 255.0f};

bool views_open(Views *views, Error *no_font, Error *error)
{
    *views = (Views){0};
    target_open(&views->target);
    ray_view_open(&views->rays);
    return triangle_view_open(&views->triangles, error) &&
           sphere_view_open(&views->spheres, error) &&
           line_view_open(&views->boxes, false, error) &&
           line_view_open(&views->normals, true, error) &&
           text_view_open(&views->text, no_font, error);
}

void views_close(Views *views)
{
    text_view_close(&views->text);
    ray_view_close(&views->rays);
    drawing_close(&views->normals.drawing);
    drawing_close(&views->boxes.drawing);
    drawing_close(&views->spheres);
    drawing_close(&views->triangles);
    target_close(&views->target);
    *views = (Views){0};
}

void views_load(Views *views, const Model *model)
{
    views->has_boxes = views->has_normals = false;
    triangle_view_load(&views->triangles, model);
}

static bool load_boxes(Views *views, const Frame *frame, Error *error)
{
    Boxes boxes = {0};
    const uint32_t depth = frame->state->box_depth;
    if (views->has_boxes && views->boxes_depth == depth)
        return true;
    const bool ok = !frame->has_tree || boxes_make(&boxes, &frame->model->stages.bvh, depth, error);
    line_view_load(&views->boxes, boxes.data, ok ? boxes.count : 0);
    boxes_free(&boxes);
    views->has_boxes = frame->has_tree;
    views->boxes_depth = depth;
    return ok;
}

static bool load_normals(Views *views, const Model *model, Error *error)
{
    Boxes lines = {0};
    if (views->has_normals)
        return true;
    const bool ok = boxes_of_normals(&lines, model, error);
    line_view_load(&views->normals, lines.data, ok ? lines.count : 0);
    boxes_free(&lines);
    views->has_normals = true;
    return ok;
}

static Tone tone_of(const Frame *frame)
{
    return (Tone){state_gain(frame->state), frame->encoding == ENCODE_SRGB};
}

static void clear(const Frame *frame)
{
    const Scene *scene = &frame->model->scene;
    const double gain = state_gain(frame->state);
    float color[3];
    unsigned char bytes[3];
    vec3_store(color, scene->background);
    framebuffer_encode(color, 3, frame->encoding, gain, bytes);
    glClearColor((float)bytes[0] / 255, (float)bytes[1] / 255, (float)bytes[2] / 255, 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

static void draw_scene(Views *views, const Frame *frame, const Lens *lens)
{
    const Tone tone = tone_of(frame);
    // Moves triangles away from the eye, so that lines on them stay visible.
    if (frame->state->boxes || frame->state->normals)
        glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(1, 1);
    triangle_view_draw(&views->triangles, frame->model, lens, &tone);
    glDisable(GL_POLYGON_OFFSET_FILL);
    sphere_view_draw(&views->spheres, frame->model, lens, &tone);
}

static bool draw_lines(Views *views, const Frame *frame, const Lens *lens, Error *error)
{
    const State *state = frame->state;
    bool ok = true;
    if (state->boxes) {
        ok = load_boxes(views, frame, error);
        line_view_draw(&views->boxes, lens, state->box_depth == 0 ? blue : red);
    }
    if (state->normals) {
        ok = load_normals(views, frame->model, error) && ok;
        line_view_draw(&views->normals, lens, red);
    }
    return ok;
}

static bool has_picture(Canvas *canvas)
{
    pthread_mutex_lock(&canvas->mutex);
    const bool has = canvas_whole(canvas) != NULL;
    pthread_mutex_unlock(&canvas->mutex);
    return has;
}

static bool draw(Views *views, const Frame *frame, uint32_t factor, Error *error)
{
    const State *state = frame->state;
    const uint32_t width = frame->width * factor, height = frame->height * factor;
    const Lens lens = lens_of(&frame->camera, &frame->model->normalization, width, height);
    clear(frame);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_DEPTH_CLAMP);
    if (lens.farthest > 0)
        glEnable(GL_CLIP_DISTANCE0);
    glDepthFunc(GL_LEQUAL);
    if (!frame->is_traced || state->boxes || state->normals || !has_picture(frame->canvas))
        draw_scene(views, frame, &lens);
    if (frame->is_traced)
        ray_view_draw(&views->rays, frame->canvas, width, height);
    const bool ok = draw_lines(views, frame, &lens, error);
    glDisable(GL_CLIP_DISTANCE0);
    glDisable(GL_DEPTH_CLAMP);
    glDisable(GL_DEPTH_TEST);
    return ok;
}

bool views_draw(Views *views, const Frame *frame, Error *error)
{
    const uint32_t factor =
        frame->state->smooth && !frame->state->traced && !frame->is_moving ? 2 : 1;
    if (!target_begin(&views->target, frame->width, frame->height, factor, error))
        return false;
    const bool ok = draw(views, frame, factor, error);
    target_show(&views->target);
    return ok;
}
