// SPDX-License-Identifier: MIT
// Draws the picture, then the text over it. The text describes the picture's settings.
#include "view/viewer_inside.h"

#include "base/clock.h"

#include <string.h>

static Figures figures_of(const Viewer *viewer)
{
    const WorkerStatus *status = &viewer->status;
    const uint64_t *tallies = status->tallies;
    const char *slash = strrchr(viewer->settings.scene_path, '/');
    Figures figures = {.scene_name = slash == NULL ? viewer->settings.scene_path : slash + 1,
                       .width = viewer->request.width,
                       .height = viewer->request.height,
                       .samples = viewer->settings.samples,
                       .divisor = status->reached.divisor,
                       .is_finished = worker_is_finished(status, &viewer->request),
                       .progress = status->progress,
                       .frame_seconds = status->frame_seconds,
                       .has_counts = status->reached.is_counted,
                       .rays = tallies[TALLY_CAMERA_RAYS] + tallies[TALLY_SHADOW_RAYS] +
                               tallies[TALLY_REFLECTED_RAYS],
                       .box_count = viewer->views.boxes.count,
                       .busy = status->busy,
                       .notice = viewer->notice,
                       .failure = status->scene_failure.text};
    if (figures.rays > 0)
        figures.tests_per_ray = (double)tallies[TALLY_TRIANGLE_TESTS] / (double)figures.rays;
    if (figures.failure[0] == '\0')
        figures.failure = status->failure.text;
    if (figures.failure[0] == '\0')
        figures.failure = viewer->failure.text;
    return figures;
}

bool viewer_is_settled(const Viewer *viewer)
{
    const WorkerStatus *status = &viewer->status;
    const bool still = worker_is_finished(status, &viewer->request) &&
                       (!viewer->state.traced || status->reached.is_counted);
    return viewer->model != NULL && status->has_tree && status->busy[0] == '\0' &&
           !viewer->wants_save && !viewer->saver.is_running && (viewer->state.turning || still);
}

static Frame frame_of(Viewer *viewer)
{
    const bool lags = viewer->state.traced && viewer->status.reached.subject > 0;
    return (Frame){.state = &viewer->state,
                   .model = viewer->model,
                   .has_tree = viewer->status.has_tree,
                   .canvas = &viewer->canvas,
                   .camera = lags ? viewer->status.done.camera : viewer->state.camera,
                   .width = viewer->request.width,
                   .height = viewer->request.height,
                   .encoding = viewer->settings.encoding};
}

static void draw_text(Viewer *viewer, const Figures *figures)
{
    char text[STATUS_TEXT_SIZE];
    if (!viewer->state.text && !viewer->state.help)
        return;
    status_text_overlay(text, sizeof text, &viewer->state, figures);
    text_view_draw(&viewer->views.text, text, viewer->request.width, viewer->request.height,
                   window_text_scale(&viewer->window));
}

static void update_title(Viewer *viewer, const Figures *figures)
{
    char text[STATE_SIZE];
    status_text_title(text, sizeof text, &viewer->state, figures);
    if (strcmp(text, viewer->title) == 0)
        return;
    window_set_title(&viewer->window, text);
    memcpy(viewer->title, text, sizeof text);
}

// With -v, prints a changed state to standard error once nothing moves.
static void print_state(Viewer *viewer, const Figures *figures)
{
    char text[STATE_SIZE];
    if (!viewer->settings.verbose || viewer->state.turning || !viewer_is_settled(viewer))
        return;
    status_text_state(text, sizeof text, &viewer->state, figures);
    if (strcmp(text, viewer->printed_state) == 0)
        return;
    fprintf(stderr, "%s\n", text);
    memcpy(viewer->printed_state, text, sizeof text);
}

// Prints a new failure once. The overlay continues to display it.
static void print_failure(Viewer *viewer, const Figures *figures)
{
    char text[STATE_SIZE];
    snprintf(text, sizeof text, "%s", figures->failure);
    if (strcmp(text, viewer->printed_failure) == 0)
        return;
    if (text[0] != '\0')
        fprintf(stderr, "clrt: %s\n", text);
    memcpy(viewer->printed_failure, text, sizeof text);
}

// Returns false if the camera turns and the traced picture is still the previous one. Such frames
// are neither timed nor counted.
static bool is_new_frame(const Viewer *viewer)
{
    return !viewer->state.turning || !viewer->state.traced ||
           viewer->status.moving_frames != viewer->moving_shown;
}

static void count_frame(Viewer *viewer, bool was_settled)
{
    const bool is_new = is_new_frame(viewer);
    viewer->moving_shown = viewer->status.moving_frames;
    if (!viewer->state.turning)
        frame_times_pause(&viewer->frame_times);
    else if (is_new)
        frame_times_add(&viewer->frame_times, clock_seconds(), &viewer->failure);
    if (was_settled && is_new && script_count_frame(&viewer->script))
        viewer->quits = true;
}

bool viewer_draw(Viewer *viewer, Error *error)
{
    const Frame frame = frame_of(viewer);
    const bool was_settled = viewer_is_settled(viewer);
    viewer->is_dirty = viewer->window.is_touched = false;
    if (frame.width == 0 || frame.height == 0)
        return true;
    if (!views_draw(&viewer->views, &frame, error))
        return false;
    const Figures figures = figures_of(viewer);
    draw_text(viewer, &figures);
    update_title(viewer, &figures);
    window_show(&viewer->window);
    print_state(viewer, &figures);
    print_failure(viewer, &figures);
    count_frame(viewer, was_settled);
    return true;
}

// Copies the latest traced picture, or the displayed picture if none is traced.
static bool copy_traced(Viewer *viewer, Framebuffer *copy, Error *error)
{
    pthread_mutex_lock(&viewer->canvas.mutex);
    const Layer *layer = canvas_whole(&viewer->canvas);
    const Framebuffer *whole = layer == NULL ? &viewer->saver.shown : &layer->framebuffer;
    const bool ok = framebuffer_make(copy, whole->width, whole->height, error);
    if (ok)
        memcpy(copy->pixels, whole->pixels,
               (size_t)whole->width * whole->height * sizeof *whole->pixels);
    pthread_mutex_unlock(&viewer->canvas.mutex);
    return ok;
}

static bool copy_shown(Framebuffer *copy, const Framebuffer *shown, Error *error)
{
    if (!framebuffer_make(copy, shown->width, shown->height, error))
        return false;
    memcpy(copy->pixels, shown->pixels,
           (size_t)shown->width * shown->height * sizeof *shown->pixels);
    return true;
}

void viewer_save(Viewer *viewer)
{
    Saver *saver = &viewer->saver;
    Error *error = &viewer->failure;
    if (!viewer->wants_save || viewer->is_dirty || saver->is_running ||
        !worker_is_finished(&viewer->status, &viewer->request))
        return;
    const Figures figures = figures_of(viewer);
    viewer->wants_save = false;
    saver->scene_path = viewer->settings.scene_path;
    status_text_state(saver->settings, sizeof saver->settings, &viewer->state, &figures);
    const bool ok = target_read(&viewer->views.target, &saver->shown, error) &&
                    (viewer->state.traced ? copy_traced(viewer, &saver->traced, error)
                                          : copy_shown(&saver->traced, &saver->shown, error));
    if (!ok || !saver_start(saver, window_wake, error))
        saver_finish(saver);
}

void viewer_follow_saver(Viewer *viewer)
{
    if (!saver_is_done(&viewer->saver))
        return;
    viewer->is_dirty = true;
    viewer->failure = viewer->saver.error;
    snprintf(viewer->notice, sizeof viewer->notice, "%s", viewer->saver.notice);
    if (viewer->settings.verbose && viewer->notice[0] != '\0')
        fprintf(stderr, "%s\n", viewer->notice);
}
