// SPDX-License-Identifier: MIT
// Draws the picture and then the text over it, prints changes of the state, and saves pictures.
#include "view/viewer_inside.h"

#include "base/clock.h"
#include "base/print.h"
#include "base/text.h"

#include <inttypes.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// The following functions save pictures. The names of the files contain the scene's name and the
// first unused number.

#define NAME_SIZE 512

typedef struct {
    const char *scene_path; // determines the files' names
    const char *state;      // stored in both files
    char *notice;           // NOTICE_SIZE bytes for a message that names the files
} SaveText;

static bool is_free(const char *stem, const char *ending)
{
    char path[PATH_MAX];
    snprintf(path, sizeof path, "%s.%s", stem, ending);
    return access(path, F_OK) != 0;
}

// Stores the common name of the two files, without an ending: the start of the scene file's name,
// and a number.
static void write_stem(char stem[NAME_SIZE], const char *scene_path)
{
    const char *name = text_file_name(scene_path);
    const char *dot = strrchr(name, '.');
    const size_t length = dot == NULL || dot == name ? strlen(name) : (size_t)(dot - name);
    const int kept = length < NAME_SIZE / 4 ? (int)length : NAME_SIZE / 4;
    unsigned number = 1;
    do
        snprintf(stem, NAME_SIZE, "%.*s-%u", kept, name, number++);
    while (!is_free(stem, "png") || !is_free(stem, "exr"));
}

static bool write_one(const Framebuffer *picture, const char *stem, const char *ending,
                      const char *state, Error *error)
{
    char path[PATH_MAX];
    const ImageText text = {"clrt:state", state};
    const ImageSettings settings = {.format = ending, .texts = &text, .text_count = 1};
    snprintf(path, sizeof path, "%s.%s", stem, ending);
    return image_write(picture, path, &settings, error);
}

// Writes the displayed picture to a PNG file and the traced picture to an EXR file, both in the
// current folder.
static bool pictures_save(const Framebuffer *shown, const Framebuffer *traced, const SaveText *text,
                          Error *error)
{
    char stem[NAME_SIZE];
    write_stem(stem, text->scene_path);
    if (!write_one(shown, stem, "png", text->state, error) ||
        !write_one(traced, stem, "exr", text->state, error))
        return false;
    snprintf(text->notice, NOTICE_SIZE, "saved %.160s.png and .exr", stem);
    return true;
}

// Records a displayed frame of a turning camera. `moment` is in seconds.
static bool frame_times_add(FrameTimes *times, double moment, Error *error)
{
    const double before = times->latest;
    times->latest = moment;
    return before == 0 || array_push(&times->seconds, moment - before, error);
}

static int compare(const void *first, const void *second)
{
    const double *a = first, *b = second;
    return (*a > *b) - (*a < *b);
}

void frame_times_write(const FrameTimes *times, uint64_t coarse, uint64_t frames, FILE *stream)
{
    Error error = {0};
    const size_t count = times->seconds.count;
    double *sorted = memory_raw(count, sizeof *sorted, &error);
    if (sorted != NULL && count > 0) {
        memcpy(sorted, times->seconds.data, count * sizeof *sorted);
        qsort(sorted, count, sizeof *sorted, compare);
        fprintf(stream,
                "%zu moving frames: median %.1f ms, 95 %% within %.1f ms, slowest %.1f ms\n", count,
                1e3 * sorted[count / 2], 1e3 * sorted[count * 95 / 100], 1e3 * sorted[count - 1]);
    }
    free(sorted);
    if (frames > 0)
        fprintf(stream, "%" PRIu64 " traced while moving, %" PRIu64 " of them at full resolution\n",
                frames, frames - coarse);
}

void frame_times_free(FrameTimes *times)
{
    free(times->seconds.memory);
    *times = (FrameTimes){0};
}

static bool is_explained(const Viewer *viewer)
{
    return viewer->explained > 0 && viewer->status.done.explains == viewer->explained;
}

static Figures figures_of(const Viewer *viewer)
{
    const WorkerStatus *status = &viewer->status;
    const char *missing = scene_missing(&viewer->model->scene).text;
    const UpAxis up = viewer->model->scene.mesh_up;
    Figures figures = {.state = &viewer->state,
                       .request = &viewer->request,
                       .status = status,
                       .scene_name = text_file_name(viewer->settings.scene_path),
                       .up = up == UP_AUTO ? NULL : up_axis_names[up],
                       .samples = viewer->settings.samples,
                       .box_count = viewer->views.boxes.count,
                       .notice = viewer->notice,
                       .missing = missing == NULL ? "" : missing,
                       .hint = viewer->hint_end > 0 ? "h for help" : "",
                       .explanation = is_explained(viewer) ? status->explanation : "",
                       .failure = status->scene_failure.text};
    if (figures.failure[0] == '\0')
        figures.failure = status->failure.text;
    if (figures.failure[0] == '\0')
        figures.failure = viewer->failure.text;
    return figures;
}

bool viewer_is_settled(const Viewer *viewer)
{
    const WorkerStatus *status = &viewer->status;
    const bool still = viewer->moved == 0 && worker_is_finished(status, &viewer->request) &&
                       (!viewer->state.traced || status->reached.is_counted);
    return viewer->model != NULL && status->has_tree && status->busy[0] == '\0' &&
           !viewer->wants_save && (viewer->state.turning || still);
}

// Returns true if the camera has moved since the traced picture and the worker cannot trace yet,
// for example because it compiles kernels.
static bool is_outdated(const Viewer *viewer)
{
    const WorkerStatus *status = &viewer->status;
    return (status->busy[0] != '\0' || status->reached.subject == 0) &&
           memcmp(&status->done.camera, &viewer->state.camera, sizeof(Viewpoint)) != 0;
}

// OpenGL replaces an outdated traced picture, so that the window follows the camera.
static Frame frame_of(Viewer *viewer)
{
    const bool is_traced = viewer->state.traced && !is_outdated(viewer);
    const bool lags = is_traced && viewer->status.reached.subject > 0;
    return (Frame){.state = &viewer->state,
                   .is_traced = is_traced,
                   .is_moving = viewer->moved > 0,
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
    char line[STATUS_TEXT_SIZE] = "", panel[STATUS_TEXT_SIZE];
    const TextOverlay overlay = {.line = line,
                                 .panel = panel,
                                 .width = viewer->request.width,
                                 .height = viewer->request.height,
                                 .density = window_density(&viewer->window)};
    if (viewer->state.text)
        status_text_store(status_text_line, figures, line, sizeof line);
    status_text_store(status_text_panel, figures, panel, sizeof panel);
    text_view_draw(&viewer->views.text, &overlay);
}

// Returns whether `text` differs from `shown`, and copies `text` to `shown`.
static bool is_news(char shown[STATE_SIZE], const char text[STATE_SIZE])
{
    const bool differs = strcmp(text, shown) != 0;
    memcpy(shown, text, STATE_SIZE);
    return differs;
}

static void update_title(Viewer *viewer, const Figures *figures)
{
    char text[STATE_SIZE] = "";
    status_text_store(status_text_title, figures, text, sizeof text);
    if (is_news(viewer->title, text))
        glfwSetWindowTitle(viewer->window.handle, text);
}

// Prints each new failure. With -v, also prints a changed state once the picture is complete and
// the camera does not turn.
static void print_news(Viewer *viewer, const Figures *figures)
{
    char text[STATE_SIZE] = "";
    if (viewer->settings.verbose && !viewer->state.turning && viewer_is_settled(viewer)) {
        status_text_store(status_text_state, figures, text, sizeof text);
        if (is_news(viewer->printed_state, text))
            fprintf(stderr, "%s\n", text);
    }
    snprintf(text, sizeof text, "%s", figures->failure);
    if (is_news(viewer->printed_failure, text) && text[0] != '\0')
        fprintf(stderr, "clrt: %s\n", text);
}

// Records the time of the frame if the camera turns. In the traced view, ignores frames that show
// the same picture as the frame before.
static void count_frame(Viewer *viewer)
{
    const bool is_new =
        !viewer->state.traced || viewer->status.moving_frames != viewer->moving_shown;
    viewer->moving_shown = viewer->status.moving_frames;
    if (!viewer->state.turning)
        viewer->frame_times.latest = 0;
    else if (is_new)
        frame_times_add(&viewer->frame_times, clock_seconds(), &viewer->failure);
}

bool viewer_draw(Viewer *viewer, Error *error)
{
    const Frame frame = frame_of(viewer);
    viewer->is_dirty = viewer->window.is_touched = false;
    if (frame.width == 0 || frame.height == 0)
        return true;
    if (!views_draw(&viewer->views, &frame, error))
        return false;
    const Figures figures = figures_of(viewer);
    draw_text(viewer, &figures);
    update_title(viewer, &figures);
    glfwSwapBuffers(viewer->window.handle);
    print_news(viewer, &figures);
    count_frame(viewer);
    return true;
}

// Saves the displayed picture and the traced picture. Holds the canvas's lock meanwhile, because
// another pass could overwrite the traced picture. In the OpenGL view, or if there is no traced
// picture, saves the displayed picture twice.
static bool save(Viewer *viewer, const Framebuffer *shown)
{
    char state[STATE_SIZE];
    const Figures figures = figures_of(viewer);
    const SaveText text = {viewer->settings.scene_path, state, viewer->notice};
    status_text_store(status_text_state, &figures, state, sizeof state);
    pthread_mutex_lock(&viewer->canvas.mutex);
    const Layer *layer = viewer->state.traced ? canvas_whole(&viewer->canvas) : NULL;
    const bool ok =
        pictures_save(shown, layer != NULL ? &layer->framebuffer : shown, &text, &viewer->failure);
    pthread_mutex_unlock(&viewer->canvas.mutex);
    return ok;
}

void viewer_save(Viewer *viewer)
{
    Framebuffer shown = {0};
    if (!viewer->wants_save || viewer->is_dirty ||
        !worker_is_finished(&viewer->status, &viewer->request))
        return;
    viewer->wants_save = false;
    viewer->is_dirty = true;
    viewer->failure = (Error){0};
    const bool ok =
        target_read(&viewer->views.target, &shown, &viewer->failure) && save(viewer, &shown);
    if (ok && viewer->settings.verbose)
        print_text(stderr, "%s\n", viewer->notice);
    framebuffer_free(&shown);
}
