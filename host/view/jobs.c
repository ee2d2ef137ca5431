// SPDX-License-Identifier: MIT
// What the worker does, one job after the other, and the news that each leaves.
#include "view/worker_inside.h"

#include "base/clock.h"

// Between news of tiles, in seconds.
#define WAKE_STEP 0.03

// A pass that is being traced.
typedef struct {
    Worker *worker;
    const Job *job;
    Layer *layer;
} Tracing;

// News are written between these two.
static WorkerNews *begin_news(Worker *worker)
{
    pthread_mutex_lock(&worker->mutex);
    worker->news.number++;
    return &worker->news;
}

static void end_news(Worker *worker)
{
    pthread_mutex_unlock(&worker->mutex);
    worker->woken = clock_seconds();
    worker->setup.wake();
}

static void tell_busy(Worker *worker, const char *busy)
{
    begin_news(worker)->busy = busy;
    end_news(worker);
}

// Whether the pass is still of use.
static bool is_current(Worker *worker, const Job *job)
{
    pthread_mutex_lock(&worker->mutex);
    const WorkerWish *wish = &worker->wish;
    bool current = !worker->stops && wish->loads == job->wish.loads &&
                   wish->renewals == job->wish.renewals && wish->uses_bvh == job->wish.uses_bvh &&
                   wish->width == job->wish.width && wish->height == job->wish.height;
    if (job->pass.kind != PASS_MOVING)
        current = current && wish->is_traced && wish->subject == job->wish.subject &&
                  (job->pass.samples == 1 || wish->samples == job->pass.samples);
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
                         job->wish.gain);
    if (job->pass.kind == PASS_FULL && clock_seconds() - worker->woken > WAKE_STEP) {
        begin_news(worker)->progress = (double)progress->tiles_done / (double)progress->tiles;
        end_news(worker);
    }
    return is_current(worker, job);
}

// Follows what samples cost.  A first measurement counts for more than any guess, and a single slow
// picture, whose processors were busy elsewhere, for no more than twice the cost before.
static void learn(Worker *worker, const Pass *pass, double seconds, double part)
{
    const double samples = part * pass->width * pass->height * pass->samples * pass->samples;
    if (pass->kind == PASS_COUNT || samples < 1)
        return;
    const double cost = seconds / samples, before = worker->sample_seconds;
    const double trusted = cost < 2 * before ? cost : 2 * before;
    worker->sample_seconds = worker->has_measured ? (before + trusted) / 2 : cost;
    worker->has_measured = true;
}

// A whole picture is news; under the lock.
static void tell_picture(WorkerNews *news, const Job *job)
{
    const Pass *pass = &job->pass;
    news->reached = (PlanReached){job->wish.subject, pass->divisor, pass->samples, false};
    news->done.subject = job->wish.subject;
    news->done.camera = job->wish.camera;
    news->done.gain = job->wish.gain;
    news->done.samples = pass->samples;
    news->done.width = job->wish.width;
    news->done.height = job->wish.height;
    news->moving_frames += pass->kind == PASS_MOVING;
    news->moving_coarse += pass->kind == PASS_MOVING && pass->divisor > 1;
}

static void finish_pass(Worker *worker, const Job *job, Layer *layer, double seconds)
{
    const RenderProgress *progress = tracer_progress(&worker->tracer, &job->pass);
    const bool whole = progress->tiles_done == progress->tiles;
    learn(worker, &job->pass, seconds, (double)progress->tiles_done / (double)progress->tiles);
    const bool shows = whole && job->pass.kind != PASS_COUNT;
    (shows ? canvas_finish : canvas_drop)(worker->setup.canvas, layer);
    WorkerNews *news = begin_news(worker);
    news->progress = 0;
    if (shows) {
        tell_picture(news, job);
        news->frame_seconds = seconds;
    } else if (whole) {
        news->reached.is_counted = true;
        for (int kind = 0; kind < TALLY_KINDS; kind++)
            news->tallies[kind] = progress->tallies[kind];
    }
    end_news(worker);
}

// What cannot be traced is given up until something else is wished.
static void give_up(Worker *worker, const Job *job, const Error *error)
{
    WorkerNews *news = begin_news(worker);
    news->reached = (PlanReached){job->wish.subject, 1, job->wish.samples, true};
    news->failure = *error;
    end_news(worker);
}

void jobs_trace(Worker *worker, const Job *job)
{
    Error error = {0};
    const RenderSettings settings = tracer_settings(&worker->tracer, &job->pass);
    const bool hidden = job->pass.kind != PASS_FULL;
    Layer *layer = canvas_begin(worker->setup.canvas, &settings, hidden, &error);
    Tracing tracing = {worker, job, layer};
    const RenderObserver observer = {tile_done, &tracing};
    const Shot shot = {&job->wish.camera, &job->pass};
    const double start = clock_seconds();
    if (layer != NULL &&
        tracer_draw(&worker->tracer, &shot, &observer, &layer->framebuffer, &error)) {
        finish_pass(worker, job, layer, clock_seconds() - start);
        return;
    }
    if (layer != NULL)
        canvas_drop(worker->setup.canvas, layer);
    give_up(worker, job, &error);
}

// The renderer is made for what was wished, or cannot be; error is empty where it is.
static void tell_taken(Worker *worker, const Job *job, const Error *error)
{
    WorkerNews *news = begin_news(worker);
    news->done.uses_bvh = job->wish.uses_bvh;
    news->done.renewals = job->wish.renewals;
    news->failure = *error;
    news->busy = "";
    if (error->text[0] == '\0')
        news->reached = (PlanReached){0};
    end_news(worker);
}

// The same of the scene.
static void tell_loaded(Worker *worker, const Job *job, const Error *error)
{
    WorkerNews *news = begin_news(worker);
    news->done.loads = job->wish.loads;
    news->scene_failure = *error;
    news->busy = "";
    end_news(worker);
}

static bool take(Worker *worker, const Job *job, Model *model, Error *error)
{
    tell_busy(worker, "compiling the kernels");
    const bool ok = tracer_take(&worker->tracer, model, job->wish.uses_bvh, error);
    if (ok) {
        worker->sample_seconds =
            plan_first_guess((uint32_t)model->triangles.count, job->wish.uses_bvh);
        worker->has_measured = false;
    }
    return ok;
}

// Puts the model, whose tree may still be missing, where the window finds it.
static void publish(Worker *worker, Model *model, bool has_tree)
{
    WorkerNews *news = begin_news(worker);
    Model *before = worker->model;
    worker->model = model_hold(model);
    news->models += before != model;
    news->has_tree = has_tree;
    end_news(worker);
    model_release(before);
}

void jobs_load(Worker *worker, const Job *job)
{
    Error error = {0};
    tell_busy(worker, "reading the scene");
    Model *model = model_load(job->wish.path, worker->setup.options->threads, &error);
    const BvhSettings tree = tracer_tree(&worker->tracer);
    if (model != NULL && model_build_tree(model, &tree, worker->setup.options->threads, &error)) {
        Error cause = {0};
        if (take(worker, job, model, &cause))
            publish(worker, model, true);
        tell_taken(worker, job, &cause);
    }
    model_release(model);
    tell_loaded(worker, job, &error);
}

static void tell_fault(Worker *worker, WorkerFault fault, const Error *error)
{
    WorkerNews *news = begin_news(worker);
    news->fault = fault;
    news->failure = *error;
    news->busy = "";
    end_news(worker);
}

// The first scene is shown before the device is open and the tree built.
bool jobs_begin(Worker *worker)
{
    Error error = {0};
    pthread_mutex_lock(&worker->mutex);
    const Job job = {.kind = JOB_LOAD, .wish = worker->wish};
    pthread_mutex_unlock(&worker->mutex);
    Model *model = model_load(job.wish.path, worker->setup.options->threads, &error);
    if (model == NULL) {
        tell_fault(worker, FAULT_SCENE, &error);
        return false;
    }
    publish(worker, model, false);
    tell_busy(worker, "opening the device");
    bool ok = tracer_open(&worker->tracer, worker->setup.options, &error);
    const BvhSettings tree = tracer_tree(&worker->tracer);
    ok = ok && model_build_tree(model, &tree, worker->setup.options->threads, &error);
    if (ok)
        publish(worker, model, true);
    ok = ok && take(worker, &job, model, &error);
    model_release(model);
    if (!ok) {
        tell_fault(worker, FAULT_DEVICE, &error);
        return false;
    }
    tell_taken(worker, &job, &error);
    tell_loaded(worker, &job, &error);
    return true;
}

void jobs_take(Worker *worker, const Job *job)
{
    Error error = {0};
    take(worker, job, worker->tracer.model, &error);
    tell_taken(worker, job, &error);
}

void jobs_encode(Worker *worker, const Job *job)
{
    canvas_encode_again(worker->setup.canvas, job->wish.gain);
    begin_news(worker)->done.gain = job->wish.gain;
    end_news(worker);
}
