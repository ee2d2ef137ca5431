// SPDX-License-Identifier: MIT
// Updates the viewer with the worker's results, dropped files and changed files.
#include "view/viewer_inside.h"

#include "base/clock.h"
#include "base/file.h"

#include <stdlib.h>

// The window displays the help hint for this many seconds.
#define HINT_SECONDS 5

// Seconds between checks of the files.
#define POLL_SECONDS 0.2

static void describe_scene(Viewer *viewer)
{
    const Scene *scene = &viewer->model->scene;
    viewer->scene = (StateScene){
        .viewpoints = scene->viewpoints.data,
        .viewpoint_count = scene->viewpoints.count,
        .is_course = scene->has_course_views,
        .deepest = viewer->status.has_tree ? boxes_deepest(&viewer->model->stages.bvh) : 0};
}

bool viewer_watch_files(Viewer *viewer, Error *error)
{
    ARRAY(const char *) paths = {0};
    const char *path = viewer->settings.scene_path;
    const Scene *scene = viewer->model == NULL ? NULL : &viewer->model->scene;
    bool ok = array_push(&paths, path, error);
    for (size_t i = 0; ok && scene != NULL && i < scene->inputs.count; i++)
        ok = array_push(&paths, scene->inputs.data[i], error);
    viewer->is_failure_followed = viewer->status.scene_failure.text[0] != '\0';
    char *folder = viewer->is_failure_followed ? file_path_beside(path, ".", error) : NULL;
    if (folder != NULL)
        ok = ok && array_push(&paths, folder, error);
    ok = ok && watch_set(&viewer->scene_files, paths.data, paths.count, error);
    free(folder);
    free(paths.memory);
    return ok;
}

bool viewer_adopt_model(Viewer *viewer, Error *error)
{
    const char *before = viewer->model == NULL ? NULL : viewer->model->path;
    const bool is_first = before == NULL;
    const ViewerSettings *settings = &viewer->settings;
    model_release(viewer->model);
    viewer->model = worker_model(viewer->worker);
    describe_scene(viewer);
    if (is_first && settings->view > viewer->scene.viewpoint_count)
        return error_set(error, "%s: there is no view %u; the last one is %zu",
                         settings->scene_path, settings->view, viewer->scene.viewpoint_count);
    if (is_first)
        viewer->state = state_begin(&viewer->scene, (State){.view = settings->view,
                                                            .exposure = settings->exposure,
                                                            .traced = settings->keys == NULL,
                                                            .smooth = settings->smooth,
                                                            .uses_bvh = settings->uses_bvh});
    if (is_first && settings->keys == NULL)
        viewer->hint_end = clock_seconds() + HINT_SECONDS;
    if (!is_first)
        (viewer->model->path == before ? state_adopt : state_open)(&viewer->state, &viewer->scene);
    viewer->request.subject++;
    views_load(&viewer->views, viewer->model);
    return viewer_watch_files(viewer, error);
}

bool viewer_follow_worker(Viewer *viewer, Error *error)
{
    WorkerStatus status;
    worker_poll(viewer->worker, &status);
    if (status.number == viewer->status.number)
        return true;
    const bool has_model = status.models != viewer->status.models;
    const bool has_tree = status.has_tree != viewer->status.has_tree;
    if (status.done.explains != viewer->status.done.explains && viewer->settings.verbose)
        fputs(status.explanation, stderr);
    viewer->status = status;
    viewer->is_dirty = true;
    if (has_model && !viewer_adopt_model(viewer, error))
        return false;
    if (has_tree && viewer->model != NULL) {
        describe_scene(viewer);
        viewer->views.has_boxes = false;
    }
    const bool failed = status.scene_failure.text[0] != '\0';
    return viewer->model == NULL || failed == viewer->is_failure_followed ||
           viewer_watch_files(viewer, error);
}

bool viewer_take_drop(Viewer *viewer, Error *error)
{
    char *path = viewer->window.dropped;
    if (path == NULL)
        return true;
    if (!array_push(&viewer->dropped, path, error))
        return false;
    viewer->window.dropped = NULL;
    viewer->settings.scene_path = viewer->request.path = path;
    viewer->request.load = (SceneLoadOptions){0};
    viewer->request.loads++;
    viewer->notice[0] = '\0';
    viewer->is_dirty = true;
    return viewer_watch_files(viewer, error);
}

void viewer_follow_files(Viewer *viewer)
{
    const double now = clock_seconds();
    if (now - viewer->polled < POLL_SECONDS)
        return;
    viewer->polled = now;
    viewer->request.loads += watch_poll(&viewer->scene_files);
    viewer->request.renewals += watch_poll(&viewer->kernel_files);
}

bool viewer_recover(Viewer *viewer, Error *error)
{
    if (!window_is_lost(&viewer->window))
        return true;
    views_close(&viewer->views);
    window_close(&viewer->window);
    viewer->title[0] = '\0';
    if (!window_open(&viewer->window, "clrt", viewer->request.width, viewer->request.height,
                     error) ||
        !views_open(&viewer->views, &viewer->failure, error))
        return false;
    views_load(&viewer->views, viewer->model);
    return true;
}
