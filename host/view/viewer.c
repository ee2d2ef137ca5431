// SPDX-License-Identifier: MIT
// The window's main loop. Events and the worker's status change the state. The loop posts the state
// to the worker as a request, and redraws the window if something changed.
#include "view/viewer_inside.h"

#include "base/clock.h"

#include <stdlib.h>
#include <string.h>

// The loop's longest sleep in seconds. Between sleeps, the loop looks for changed files. A camera
// that has not moved for this time counts as resting.
#define REST_SECONDS 0.1

// Returns the number of samples along each side of a pixel. Pictures of a moving camera are not
// anti-aliased, because slower tiles in flight would delay the next picture.
static uint32_t samples_of(const Viewer *viewer)
{
    return viewer->state.smooth && viewer->moved == 0 ? viewer->settings.samples : 1;
}

static void run_commands(Viewer *viewer, unsigned commands)
{
    if (commands & COMMAND_CAMERA) {
        status_text_camera(&viewer->state, stdout);
        fflush(stdout);
    }
    if ((commands & COMMAND_UP) && viewer->model->scene.mesh_up != UP_AUTO) {
        viewer->request.load.up = viewer->model->scene.mesh_up % UP_MINUS_Z + 1;
        viewer->request.loads++;
    }
    if (commands & COMMAND_SAVE)
        viewer->wants_save = true;
    if (commands & COMMAND_QUIT)
        viewer->quits = true;
    if (commands & COMMAND_RELOAD) {
        viewer->request.loads++;
        viewer->request.renewals++;
    }
}

static void explain(Viewer *viewer, const Event *event)
{
    WorkerRequest *request = &viewer->request;
    if (event->right < 0 || event->right >= request->width || event->down < 0 ||
        event->down >= request->height)
        return;
    request->pixel[0] = (uint32_t)event->right;
    request->pixel[1] = (uint32_t)event->down;
    viewer->explained = ++request->explains;
}

static void take_event(Viewer *viewer, const Event *event)
{
    viewer->is_dirty = true;
    viewer->notice[0] = '\0';
    viewer->explained = 0;
    const unsigned commands = state_apply(&viewer->state, event, &viewer->scene);
    if (commands & COMMAND_EXPLAIN)
        explain(viewer, event);
    run_commands(viewer, commands);
}

static void take_events(Viewer *viewer)
{
    Window *window = &viewer->window;
    for (int i = 0; i < window->event_count; i++)
        take_event(viewer, &window->events[i]);
    window->event_count = 0;
}

static bool has_keys(const Viewer *viewer)
{
    return viewer->settings.keys != NULL && viewer->settings.keys[0] != '\0';
}

// Plays the next key once the effect of the previous key is displayed.
static void play_key(Viewer *viewer)
{
    if (!has_keys(viewer) || !viewer_is_settled(viewer) || viewer->is_dirty)
        return;
    viewer->is_dirty = true;
    const Event event = {.kind = EVENT_KEY, .key = (unsigned char)*viewer->settings.keys++};
    take_event(viewer, &event);
}

// Removes an expired hint, notices that the camera rests, and advances a camera that turns
// automatically. In the ray-traced view, a turning camera waits until the picture of its current
// position is traced. No camera turns while a save is requested.
static void advance(Viewer *viewer)
{
    const double now = clock_seconds();
    if (viewer->hint_end > 0 && now >= viewer->hint_end) {
        viewer->hint_end = 0;
        viewer->is_dirty = true;
    }
    if (viewer->moved > 0 && now - viewer->moved > REST_SECONDS) {
        viewer->moved = 0;
        viewer->is_dirty = true;
    }
    const bool is_behind =
        viewer->state.traced && viewer->status.reached.subject != viewer->request.subject;
    if (viewer->state.turning && !viewer->wants_save && !is_behind) {
        state_advance(&viewer->state, now - viewer->advanced);
        viewer->is_dirty = true;
    }
    if (!viewer->state.turning || viewer->wants_save || !is_behind)
        viewer->advanced = now;
}

static void post_request(Viewer *viewer)
{
    WorkerRequest *request = &viewer->request;
    uint32_t width, height;
    window_measure(&viewer->window, &width, &height);
    const bool has_moved =
        memcmp(&request->camera, &viewer->state.camera, sizeof request->camera) != 0;
    if (has_moved)
        viewer->moved = clock_seconds();
    if (width != request->width || height != request->height || has_moved) {
        request->subject++;
        viewer->explained = 0;
        viewer->is_dirty = true;
    }
    request->camera = viewer->state.camera;
    request->width = width;
    request->height = height;
    request->samples = samples_of(viewer);
    request->is_traced = viewer->state.traced;
    request->uses_bvh = viewer->state.uses_bvh;
    request->gain = state_gain(&viewer->state);
    worker_request(viewer->worker, request);
}

// Returns the number of seconds that the loop may sleep.
static double idle_seconds(const Viewer *viewer)
{
    const bool plays = has_keys(viewer) && viewer_is_settled(viewer);
    const bool turns = viewer->state.turning && !viewer->state.traced;
    return viewer->is_dirty || plays || turns ? 0 : REST_SECONDS;
}

static bool step(Viewer *viewer, Error *error)
{
    const double rest = idle_seconds(viewer);
    if (rest > 0)
        glfwWaitEventsTimeout(rest);
    else
        glfwPollEvents();
    if (!viewer_follow_worker(viewer, error))
        return false;
    take_events(viewer);
    if (!viewer_take_drop(viewer, error))
        return false;
    play_key(viewer);
    window_set_full_screen(&viewer->window, viewer->state.full_screen);
    viewer_follow_files(viewer);
    advance(viewer);
    post_request(viewer);
    if ((viewer->is_dirty || viewer->window.is_touched) && !viewer_draw(viewer, error))
        return false;
    viewer_save(viewer);
    viewer->quits = viewer->quits || glfwWindowShouldClose(viewer->window.handle);
    return viewer_recover(viewer, error);
}

// Waits for the first scene, which determines the window's size.
static bool await_scene(Viewer *viewer)
{
    do {
        glfwWaitEventsTimeout(REST_SECONDS);
        worker_poll(viewer->worker, &viewer->status);
    } while (viewer->status.models == 0 && viewer->status.fault == FAULT_NONE);
    return viewer->status.fault == FAULT_NONE;
}

static bool open_window(Viewer *viewer, Error *error)
{
    const ViewerSettings *settings = &viewer->settings;
    Model *model = worker_model(viewer->worker);
    const uint32_t width = settings->width > 0 ? settings->width : model->scene.width;
    const uint32_t height = settings->width > 0 ? settings->height : model->scene.height;
    model_release(model);
    return window_open(&viewer->window, "clrt", width, height, error) &&
           views_open(&viewer->views, &viewer->failure, error);
}

static ViewerEnd end_of_fault(const Viewer *viewer, Error *error)
{
    error_set(error, "%s", viewer->status.failure.text);
    return viewer->status.fault == FAULT_SCENE ? VIEWER_NO_SCENE : VIEWER_NO_DEVICE;
}

static ViewerEnd show(Viewer *viewer, Error *error)
{
    if (!await_scene(viewer))
        return end_of_fault(viewer, error);
    if (!open_window(viewer, error))
        return VIEWER_NO_WINDOW;
    if (!viewer_adopt_model(viewer, error))
        return VIEWER_NO_SCENE;
    while (!viewer->quits) {
        if (!step(viewer, error))
            return VIEWER_NO_WINDOW;
        if (viewer->status.fault != FAULT_NONE)
            return end_of_fault(viewer, error);
    }
    return VIEWER_CLOSED;
}

// Stops the worker and frees the viewer. If the worker does not stop in time, it may still use the
// viewer. The viewer is then not freed, and the function returns false.
static bool close_viewer(Viewer *viewer)
{
    if (viewer->window.handle != NULL)
        glfwHideWindow(viewer->window.handle);
    if (viewer->settings.statistics)
        frame_times_write(&viewer->frame_times, viewer->status.moving_coarse,
                          viewer->status.moving_frames, stderr);
    frame_times_free(&viewer->frame_times);
    watch_free(&viewer->scene_files);
    watch_free(&viewer->kernel_files);
    model_release(viewer->model);
    if (viewer->window.handle != NULL)
        views_close(&viewer->views);
    window_close(&viewer->window);
    if (viewer->worker != NULL && !worker_stop(viewer->worker, viewer->settings.patience))
        return false;
    for (size_t i = 0; i < viewer->dropped.count; i++)
        free(viewer->dropped.data[i]);
    free(viewer->dropped.memory);
    glfwTerminate();
    canvas_close(&viewer->canvas);
    free(viewer);
    return true;
}

ViewerEnd viewer_run(const ViewerSettings *settings, bool *is_stopped, Error *error)
{
    Viewer *viewer = memory_zeroed(1, sizeof *viewer, error);
    *is_stopped = true;
    if (viewer == NULL || !window_connect(error)) {
        free(viewer);
        return VIEWER_NO_WINDOW;
    }
    viewer->settings = *settings;
    viewer->request = (WorkerRequest){.path = settings->scene_path,
                                      .load = settings->load,
                                      .loads = 1,
                                      .uses_bvh = settings->uses_bvh,
                                      .samples = 1};
    viewer->status.busy = "";
    canvas_open(&viewer->canvas, settings->encoding);
    WorkerSetup setup = settings->worker;
    setup.canvas = &viewer->canvas;
    setup.wake = glfwPostEmptyEvent;
    ViewerEnd end = VIEWER_NO_DEVICE;
    // Watches the files before they are first read, so that changes during the read are detected.
    const char *kernels = settings->worker.session.kernel_folder;
    if (viewer_watch_files(viewer, error) &&
        watch_set(&viewer->kernel_files, &kernels, kernels != NULL, error))
        viewer->worker = worker_start(&setup, &viewer->request, error);
    if (viewer->worker != NULL)
        end = show(viewer, error);
    *is_stopped = close_viewer(viewer);
    return end;
}
