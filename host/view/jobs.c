// SPDX-License-Identifier: MIT
// The worker's jobs: loading a scene, compiling it, drawing a pass, encoding colors again, and
// explaining a pixel. Each job ends with a status update.
#include "view/worker_inside.h"

#include "base/clock.h"
#include "explain/report.h"

// The shortest interval between status updates about finished tiles, in seconds.
#define WAKE_STEP 0.03

// For this many seconds, a request for another camera does not stop PASS_MOVING, so that pictures
// of a moving camera appear at all. After this time, the request stops the pass, because the pass
// may take very long in a large scene without a tree.
#define MOVING_SECONDS 0.5

// A pass in progress.
typedef struct {
    Worker *worker;
    const Job *job;
    Layer *layer;
    double start; // clock time
} Tracing;

// Locks the status. Only code between begin_update and end_update may change the status.
static WorkerStatus *begin_update(Worker *worker)
{
    pthread_mutex_lock(&worker->mutex);
    worker->status.number++;
    return &worker->status;
}

static void end_update(Worker *worker)
{
    pthread_mutex_unlock(&worker->mutex);
    worker->woken = clock_seconds();
    worker->setup.wake();
}

static void report_busy(Worker *worker, const char *busy)
{
    begin_update(worker)->busy = busy;
    end_update(worker);
}

// Returns whether the window still needs the pass.
static bool is_current(const Tracing *tracing)
{
    Worker *worker = tracing->worker;
    const Job *job = tracing->job;
    const bool is_kept =
        job->pass.kind == PASS_MOVING && clock_seconds() - tracing->start < MOVING_SECONDS;
    pthread_mutex_lock(&worker->mutex);
    const WorkerRequest *request = &worker->request;
    bool current = !worker->stops && request->loads == job->request.loads &&
                   request->renewals == job->request.renewals &&
                   request->uses_bvh == job->request.uses_bvh &&
                   request->width == job->request.width && request->height == job->request.height;
    if (!is_kept)
        current =
            current && request->is_traced && request->subject == job->request.subject &&
            request->explains == job->request.explains &&
            (job->pass.settings.samples == 1 || request->samples == job->pass.settings.samples);
    pthread_mutex_unlock(&worker->mutex);
    return current;
}

static bool tile_done(void *context, const RenderProgress *progress)
{
    const Tracing *tracing = context;
    Worker *worker = tracing->worker;
    const Job *job = tracing->job;
    if (job->pass.kind != PASS_COUNT)
        canvas_add_tiles(worker->setup.canvas, tracing->layer, progress->tiles_done,
                         job->request.gain);
    if (job->pass.kind == PASS_FULL && clock_seconds() - worker->woken > WAKE_STEP) {
        begin_update(worker)->progress = (double)progress->tiles_done / (double)progress->tiles;
        end_update(worker);
    }
    return is_current(tracing);
}

// Updates the measured time per sample. `part` is the finished fraction of the pass. The first
// measurement replaces the guess. A later measurement raises the time by at most half, because
// other processes may have slowed the pass.
static void update_sample_cost(Worker *worker, const Pass *pass, double seconds, double part)
{
    const RenderSettings *settings = &pass->settings;
    const double samples =
        part * settings->width * settings->height * settings->samples * settings->samples;
    if (pass->kind == PASS_COUNT || samples < 1)
        return;
    const double cost = seconds / samples, before = worker->sample_seconds;
    const double trusted = cost < 2 * before ? cost : 2 * before;
    worker->sample_seconds = worker->has_measured ? (before + trusted) / 2 : cost;
    worker->has_measured = true;
}

// Records a complete picture. The caller holds the lock.
static void record_picture(WorkerStatus *status, const Job *job)
{
    const Pass *pass = &job->pass;
    status->reached =
        (PlanReached){job->request.subject, pass->divisor, pass->settings.samples, false};
    status->done.camera = job->request.camera;
    status->done.gain = job->request.gain;
    status->moving_frames += pass->kind == PASS_MOVING;
    status->moving_coarse += pass->kind == PASS_MOVING && pass->divisor > 1;
}

static void finish_pass(Worker *worker, const Job *job, Layer *layer, double seconds)
{
    const RenderProgress *progress = &worker->drawn.progress;
    const bool whole = progress->tiles_done == progress->tiles;
    update_sample_cost(worker, &job->pass, seconds,
                       (double)progress->tiles_done / (double)progress->tiles);
    const bool shows = whole && job->pass.kind != PASS_COUNT;
    canvas_end(worker->setup.canvas, layer, shows);
    WorkerStatus *status = begin_update(worker);
    status->progress = 0;
    if (shows) {
        record_picture(status, job);
        status->frame_seconds = seconds;
    } else if (whole) {
        status->reached.is_counted = true;
        for (int kind = 0; kind < TALLY_KINDS; kind++)
            status->tallies[kind] = progress->tallies[kind];
    }
    end_update(worker);
}

// Reports that the requested picture cannot be traced. Stores the picture in status->reached as if
// it were complete, so that the worker tries again only after a different request.
static void report_failure(Worker *worker, const Job *job, const Error *error)
{
    WorkerStatus *status = begin_update(worker);
    status->reached = (PlanReached){job->request.subject, 1, job->request.samples, true};
    status->failure = *error;
    end_update(worker);
}

void jobs_trace(Worker *worker, const Job *job)
{
    Error error = {0};
    SessionPicture picture = {.settings = job->pass.settings,
                              .viewpoint = job->request.camera,
                              .wanted.statistics = job->pass.kind == PASS_COUNT};
    const bool hidden = job->pass.kind != PASS_FULL;
    Layer *layer = canvas_begin(worker->setup.canvas, &picture.settings, hidden, &error);
    const double start = clock_seconds();
    Tracing tracing = {worker, job, layer, start};
    const RenderObserver observer = {tile_done, &tracing};
    if (layer != NULL && session_draw_picture(&worker->session, &picture, &observer,
                                              &layer->framebuffer, &worker->drawn, &error)) {
        finish_pass(worker, job, layer, clock_seconds() - start);
        return;
    }
    if (layer != NULL)
        canvas_end(worker->setup.canvas, layer, false);
    report_failure(worker, job, &error);
}

static void report_taken(Worker *worker, const Job *job, uint64_t renewals, const Error *error)
{
    WorkerStatus *status = begin_update(worker);
    status->done.uses_bvh = job->request.uses_bvh;
    status->done.renewals = renewals;
    status->failure = *error;
    status->busy = "";
    if (error->text[0] == '\0')
        status->reached = (PlanReached){0};
    end_update(worker);
}

static void report_loaded(Worker *worker, const Job *job, const Error *error)
{
    WorkerStatus *status = begin_update(worker);
    status->done.loads = job->request.loads;
    status->scene_failure = *error;
    status->busy = "";
    end_update(worker);
}

static void report_fault(Worker *worker, WorkerFault fault, const Error *error)
{
    WorkerStatus *status = begin_update(worker);
    status->fault = fault;
    status->failure = *error;
    end_update(worker);
}

// Compiles the scene and the kernels for the next pass.
static bool prepare(Worker *worker, Error *error)
{
    report_busy(worker, "compiling the kernels");
    return session_prepare_picture(&worker->session, &(SessionPicture){0}, &worker->drawn, error);
}

// Passes the model to the session, which then traces it. If the request's uses_bvh is false, rays
// test all triangles. On failure, the worker keeps the previous model.
static bool take(Worker *worker, const Job *job, Model *model, Error *error)
{
    Session *session = &worker->session;
    SessionScene before = session->scene;
    const ClrtTree tree = session->settings.wanted.tree;
    const bool uses_bvh = job->request.uses_bvh;
    session->scene = (SessionScene){
        .scene = &model->scene, .normalization = model->normalization, .stages = &model->stages};
    session->settings.wanted.tree = uses_bvh ? CLRT_TREE_SAH : CLRT_TREE_NONE;
    if (!prepare(worker, error)) {
        session_scene_free(&session->scene);
        session->scene = before;
        session->settings.wanted.tree = tree;
        return false;
    }
    Model *held = model_hold(model);
    session_scene_free(&before);
    model_release(worker->traced);
    worker->traced = held;
    worker->sample_seconds = plan_first_guess((uint32_t)model->stages.triangles.count, uses_bvh);
    worker->has_measured = false;
    return true;
}

// Compiles the kernels again, from the kernel folder if there is one. On failure, the worker keeps
// the previous kernels.
static void renew(Worker *worker, Error *error)
{
    KernelSet *kernels = &worker->session.kernels;
    KernelSet before = *kernels;
    *kernels = (KernelSet){.source = before.source};
    const bool ok = prepare(worker, error);
    kernel_set_clear(ok ? &before : kernels);
    if (!ok)
        *kernels = before;
}

// Publishes the model for the window. `has_tree` is false while the model's tree is not built.
static void publish(Worker *worker, Model *model, bool has_tree)
{
    WorkerStatus *status = begin_update(worker);
    Model *before = worker->model;
    worker->model = model_hold(model);
    status->models += before != model;
    status->has_tree = has_tree;
    end_update(worker);
    model_release(before);
}

// Loads a scene. Publishes the first scene before the device is open, so that the window opens
// early. Later scenes are published after their kernels are compiled.
void jobs_load(Worker *worker, const Job *job)
{
    Error scene_failure = {0}, failure = {0};
    const uint32_t threads = worker->setup.session.wanted.threads;
    const bool is_first = worker->model == NULL;
    report_busy(worker, "reading the scene");
    Model *model = model_load(job->request.path, &job->request.load, threads, &scene_failure);
    bool ok = model != NULL;
    if (ok && is_first) {
        publish(worker, model, false);
        report_busy(worker, "opening the device");
        worker->session =
            (Session){.settings = worker->setup.session, .cache = worker->setup.cache};
        ok = session_open(&worker->session, &failure);
    }
    if (ok) {
        const BvhSettings tree = {session_scene_builder(&worker->setup.session.wanted),
                                  flat_leaves(worker->session.choice.nodes)};
        ok = model_build_tree(model, &tree, threads, is_first ? &failure : &scene_failure);
    }
    if (ok && is_first)
        publish(worker, model, true);
    if (ok && take(worker, job, model, &failure))
        publish(worker, model, true);
    if (worker->traced == NULL)
        report_fault(worker, model == NULL ? FAULT_SCENE : FAULT_DEVICE,
                     model == NULL ? &scene_failure : &failure);
    else if (ok)
        report_taken(worker, job, worker->status.done.renewals, &failure);
    report_loaded(worker, job, &scene_failure);
    model_release(model);
}

void jobs_take(Worker *worker, const Job *job)
{
    Error error = {0};
    const WorkerRequest *done = &worker->status.done;
    const bool is_taken =
        job->request.uses_bvh == done->uses_bvh || take(worker, job, worker->traced, &error);
    if (is_taken && job->request.renewals != done->renewals)
        renew(worker, &error);
    report_taken(worker, job, job->request.renewals, &error);
}

void jobs_explain(Worker *worker, const Job *job)
{
    Error error = {0};
    char text[EXPLANATION_SIZE] = "";
    const WorkerRequest *request = &job->request;
    const RenderSettings settings = worker_settings(worker, request);
    const ExplainReport report = {.scene = &worker->traced->scene,
                                  .settings = &settings,
                                  .pixel = {request->pixel[0], request->pixel[1]},
                                  .encoding = worker->setup.canvas->encoding,
                                  .is_brief = true};
    report_busy(worker, "explaining the pixel");
    Explainer explainer;
    FILE *stream = fmemopen(text, sizeof text - 1, "w"); // the last byte stays zero
    bool ok = stream != NULL &&
              explainer_open(&explainer, &worker->session, &settings, &request->camera, &error);
    if (ok) {
        ok = explain_write_text(&report, &explainer, stream, &error);
        explainer_close(&explainer);
    }
    if (stream != NULL)
        fclose(stream);
    WorkerStatus *status = begin_update(worker);
    snprintf(status->explanation, sizeof status->explanation, "%s", ok ? text : error.text);
    status->done.explains = request->explains;
    status->busy = "";
    end_update(worker);
}

void jobs_encode(Worker *worker, const Job *job)
{
    canvas_encode_again(worker->setup.canvas, job->request.gain);
    begin_update(worker)->done.gain = job->request.gain;
    end_update(worker);
}
