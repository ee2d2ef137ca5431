// SPDX-License-Identifier: MIT
// Transfers the worker's results, dropped files and changes of files into the viewer.
#include "view/viewer_inside.h"

#include "base/clock.h"

#include <stdlib.h>

static void describe_scene(Viewer *viewer)
{
    const Scene *scene = &viewer->model->scene;
    viewer->scene =
        (StateScene){.viewpoints = scene->viewpoints.data,
                     .viewpoint_count = scene->viewpoints.count,
                     .is_course = scene->has_course_views,
                     .levels = viewer->status.has_tree ? boxes_levels(&viewer->model->bvh) : 0};
}

static bool follow_files(Viewer *viewer, Error *error)
{
    const bool failed = viewer->status.scene_failure.text[0] != '\0';
    viewer->is_failure_followed = failed;
    return reload_follow(&viewer->reload, &viewer->model->scene, viewer->settings.scene_path,
                         failed, error);
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
        return error_set(error, "%s has %zu viewpoints, so there is no view %u",
                         settings->scene_path, viewer->scene.viewpoint_count, settings->view);
    if (is_first) {
        viewer->state =
            state_begin(&viewer->scene, settings->view, settings->smooth, settings->uses_bvh);
        viewer->state.exposure = settings->exposure;
    } else
        (viewer->model->path == before ? state_adopt : state_open)(&viewer->state, &viewer->scene);
    viewer->request.subject++;
    return views_load(&viewer->views, viewer->model, error) && follow_files(viewer, error);
}

bool viewer_follow_worker(Viewer *viewer, Error *error)
{
    WorkerStatus status;
    worker_poll(viewer->worker, &status);
    if (status.number == viewer->status.number)
        return true;
    const bool has_model = status.models != viewer->status.models;
    const bool has_tree = status.has_tree != viewer->status.has_tree;
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
           follow_files(viewer, error);
}

bool viewer_take_drop(Viewer *viewer, Error *error)
{
    char *path = window_take_drop(&viewer->window);
    if (path == NULL)
        return true;
    if (!array_push(&viewer->dropped, path, error)) {
        free(path);
        return false;
    }
    viewer->settings.scene_path = viewer->request.path = path;
    viewer->request.up = UP_AUTO;
    viewer->request.loads++;
    viewer->notice[0] = '\0';
    viewer->is_dirty = true;
    return follow_files(viewer, error);
}

void viewer_follow_files(Viewer *viewer)
{
    const unsigned changed = reload_poll(&viewer->reload, clock_seconds());
    if (changed & RELOAD_SCENE)
        viewer->request.loads++;
    if (changed & RELOAD_KERNELS)
        viewer->request.renewals++;
}

bool viewer_renew(Viewer *viewer, Error *error)
{
    viewer->request.loads++;
    viewer->request.renewals++;
    views_close(&viewer->views);
    return views_open(&viewer->views, error) && views_load(&viewer->views, viewer->model, error);
}

bool viewer_recover(Viewer *viewer, Error *error)
{
    if (!window_is_lost(&viewer->window))
        return true;
    views_close(&viewer->views);
    window_close(&viewer->window);
    viewer->title[0] = '\0';
    return window_open(&viewer->window, "clrt", viewer->request.width, viewer->request.height,
                       error) &&
           views_open(&viewer->views, error) && views_load(&viewer->views, viewer->model, error);
}
