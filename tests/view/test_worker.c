// SPDX-License-Identifier: MIT
// Tests that the worker thread stops a slow picture and soon serves other requests, and that it
// reports a scene that it cannot read. The picture is slow because its rays test all triangles of a
// large mesh, without a tree.
#include "view/worker.h"

#include "base/clock.h"
#include "unit/cmocka_all.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define ACROSS 250 // squares along a side of the mesh; each square has two triangles

static char path[] = "/tmp/clrt-worker-XXXXXX.ply";

static void write_mesh(void)
{
    const int file = mkstemps(path, 4);
    FILE *stream = fdopen(file, "w");
    assert_non_null(stream);
    fprintf(
        stream,
        "ply\nformat ascii 1.0\nelement vertex %d\nproperty float x\nproperty float y\n"
        "property float z\nelement face %d\nproperty list uchar int vertex_indices\nend_header\n",
        (ACROSS + 1) * (ACROSS + 1), 2 * ACROSS * ACROSS);
    for (int i = 0; i < (ACROSS + 1) * (ACROSS + 1); i++)
        fprintf(stream, "%d %d %d\n", i % (ACROSS + 1), i / (ACROSS + 1), i % 3);
    for (int i = 0; i < ACROSS * ACROSS; i++) {
        const int a = i + i / ACROSS, b = a + ACROSS + 1;
        fprintf(stream, "3 %d %d %d\n3 %d %d %d\n", a, a + 1, b, a + 1, b + 1, b);
    }
    assert_int_equal(fclose(stream), 0);
}

static void ignore_news(void)
{
}

// Returns the next status whose number differs from `number`.
static WorkerStatus await_status(Worker *worker, uint64_t number)
{
    WorkerStatus status;
    for (int i = 0; i < 60000; i++) {
        worker_poll(worker, &status);
        if (status.number != number)
            return status;
        usleep(1000);
    }
    fail_msg("the worker does not answer");
    return status;
}

static void sleep_until(double moment)
{
    while (clock_seconds() < moment)
        usleep(10000);
}

TEST(a_long_picture_of_a_moving_camera_is_stopped)
{
    Cache cache;
    Canvas canvas;
    Error error = {0};
    cache_private_open(&cache);
    canvas_open(&canvas, ENCODE_RAW);
    const WorkerSetup setup = {.session = {.wanted = {.threads = 2}},
                               .cache = cache,
                               .canvas = &canvas,
                               .wake = ignore_news};
    // The coarse picture has 750,000 pixels.
    WorkerRequest request = {
        .path = path, .loads = 1, .width = 16000, .height = 12000, .samples = 1, .gain = 1};
    Worker *worker = worker_start(&setup, &request, &error);
    assert_non_null(worker);
    WorkerStatus status = {0};
    while (status.done.loads == 0)
        status = await_status(worker, status.number);
    assert_int_equal(status.fault, FAULT_NONE);
    Model *model = worker_model(worker);
    request.camera = model->scene.viewpoints.data[0];
    model_release(model);
    request.is_traced = true;
    request.subject = 1;
    worker_request(worker, &request);
    sleep_until(clock_seconds() + 1);
    request.is_traced = false;
    worker_request(worker, &request);
    status = await_status(worker, status.number);
    assert_int_equal(status.reached.subject, 0); // the picture was not finished
    assert_string_equal(status.failure.text, "");
    assert_true(worker_stop(worker, 60));
    canvas_close(&canvas);
    cache_private_close(&cache);
}

TEST(a_first_scene_that_cannot_be_read_is_reported)
{
    Canvas canvas;
    Error error = {0};
    canvas_open(&canvas, ENCODE_RAW);
    const WorkerSetup setup = {.canvas = &canvas, .wake = ignore_news};
    const WorkerRequest request = {
        .path = "/tmp/clrt-missing.ply", .loads = 1, .explains = 1, .uses_bvh = true};
    Worker *worker = worker_start(&setup, &request, &error);
    assert_non_null(worker);
    WorkerStatus status = {0};
    while (status.done.loads == 0)
        status = await_status(worker, status.number);
    assert_int_equal(status.fault, FAULT_SCENE);
    assert_non_null(strstr(status.failure.text, "cannot be opened"));
    sleep_until(clock_seconds() + 0.1); // time for a job without a model
    assert_true(worker_stop(worker, 60));
    canvas_close(&canvas);
}

SET_UP(make_mesh)
{
    write_mesh();
    return 0;
}

TEAR_DOWN(remove_mesh)
{
    return unlink(path);
}
