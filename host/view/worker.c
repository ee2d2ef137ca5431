// SPDX-License-Identifier: MIT
// Runs the worker's thread. The thread chooses the next job by next_kind, and runs the job (jobs.c)
// without holding the lock.
#include "view/worker_inside.h"

#include <stdlib.h>

RenderSettings worker_settings(const Worker *worker, const WorkerRequest *request)
{
    const int32_t level = worker->setup.max_level;
    const uint32_t given = level == CLRT_LEVEL_NONE ? 0 : (uint32_t)level;
    const bool is_scenes = level == 0 && worker->traced != NULL;
    return (RenderSettings){.width = request->width,
                            .height = request->height,
                            .samples = request->samples,
                            .max_level = is_scenes ? worker->traced->scene.max_level : given,
                            .tile_width = 1,
                            .tile_height = 1};
}

static Pass next_pass(const Worker *worker)
{
    const WorkerRequest *request = &worker->request;
    const PlanRequest plan = {.is_wanted = request->is_traced && worker->traced != NULL,
                              .subject = request->subject,
                              .full = worker_settings(worker, request),
                              .sample_seconds = worker->sample_seconds};
    return plan_pass(&plan, &worker->status.reached);
}

// Returns the kind of the next job. If the kind is JOB_PASS and the pass is PASS_NONE, there is
// nothing to do. If the first load has failed, there is no model for the jobs after JOB_LOAD.
static JobKind next_kind(const Worker *worker, const Pass *pass)
{
    const WorkerRequest *request = &worker->request, *done = &worker->status.done;
    if (worker->stops)
        return JOB_STOP;
    if (request->loads != done->loads)
        return JOB_LOAD;
    if (worker->traced == NULL)
        return JOB_PASS;
    if (request->uses_bvh != done->uses_bvh || request->renewals != done->renewals)
        return JOB_TAKE;
    if (request->explains != done->explains)
        return JOB_EXPLAIN;
    // After a change of gain, only PASS_MOVING may run before the latest picture is encoded again.
    return request->is_traced && request->gain != done->gain && pass->kind != PASS_MOVING
               ? JOB_ENCODE
               : JOB_PASS;
}

static Job await_job(Worker *worker)
{
    Job job;
    pthread_mutex_lock(&worker->mutex);
    for (;;) {
        job = (Job){.request = worker->request, .pass = next_pass(worker)};
        job.kind = next_kind(worker, &job.pass);
        if (job.kind != JOB_PASS || job.pass.kind != PASS_NONE)
            break;
        pthread_cond_wait(&worker->changed, &worker->mutex);
    }
    pthread_mutex_unlock(&worker->mutex);
    return job;
}

static void *work(void *context)
{
    static void (*const run[])(Worker *, const Job *) = {[JOB_LOAD] = jobs_load,
                                                         [JOB_TAKE] = jobs_take,
                                                         [JOB_EXPLAIN] = jobs_explain,
                                                         [JOB_ENCODE] = jobs_encode,
                                                         [JOB_PASS] = jobs_trace};
    Worker *worker = context;
    for (Job job = await_job(worker); job.kind != JOB_STOP; job = await_job(worker)) {
        run[job.kind](worker, &job);
        kernel_set_save(&worker->session.kernels);
    }
    session_close(&worker->session);
    model_release(worker->traced);
    return NULL;
}

static void free_worker(Worker *worker)
{
    model_release(worker->model);
    pthread_cond_destroy(&worker->changed);
    pthread_mutex_destroy(&worker->mutex);
    free(worker);
}

Worker *worker_start(const WorkerSetup *setup, const WorkerRequest *request, Error *error)
{
    Worker *worker = memory_zeroed(1, sizeof *worker, error);
    if (worker == NULL)
        return NULL;
    *worker =
        (Worker){.setup = *setup, .request = *request, .status = {.busy = "reading the scene"}};
    pthread_mutex_init(&worker->mutex, NULL);
    pthread_cond_init(&worker->changed, NULL);
    if (device_thread_start(&worker->thread, work, worker))
        return worker;
    free_worker(worker);
    error_set(error, "no thread can be started");
    return NULL;
}

void worker_request(Worker *worker, const WorkerRequest *request)
{
    pthread_mutex_lock(&worker->mutex);
    worker->request = *request;
    pthread_cond_signal(&worker->changed);
    pthread_mutex_unlock(&worker->mutex);
}

void worker_poll(Worker *worker, WorkerStatus *status)
{
    pthread_mutex_lock(&worker->mutex);
    *status = worker->status;
    pthread_mutex_unlock(&worker->mutex);
}

Model *worker_model(Worker *worker)
{
    pthread_mutex_lock(&worker->mutex);
    Model *model = worker->model == NULL ? NULL : model_hold(worker->model);
    pthread_mutex_unlock(&worker->mutex);
    return model;
}

bool worker_is_finished(const WorkerStatus *status, const WorkerRequest *request)
{
    const WorkerRequest *done = &status->done;
    const bool is_read = done->loads == request->loads && done->renewals == request->renewals &&
                         done->uses_bvh == request->uses_bvh && done->explains == request->explains;
    const PlanReached *reached = &status->reached;
    const bool is_traced = reached->subject == request->subject && reached->divisor == 1 &&
                           reached->samples == request->samples && done->gain == request->gain;
    return is_read && (!request->is_traced || is_traced);
}

bool worker_stop(Worker *worker, double seconds)
{
    struct timespec end;
    pthread_mutex_lock(&worker->mutex);
    worker->stops = true;
    pthread_cond_signal(&worker->changed);
    pthread_mutex_unlock(&worker->mutex);
    clock_gettime(CLOCK_REALTIME, &end);
    const double moment = (double)end.tv_nsec * 1e-9 + seconds;
    end.tv_sec += (time_t)moment;
    end.tv_nsec = (long)((moment - floor(moment)) * 1e9);
    if (pthread_timedjoin_np(worker->thread, NULL, &end) != 0)
        return false;
    free_worker(worker);
    return true;
}
