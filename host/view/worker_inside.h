// SPDX-License-Identifier: MIT
// The data that worker.c and jobs.c share. worker.c chooses jobs, and jobs.c runs them.
#pragma once

#include "session/picture.h"
#include "view/worker.h"

struct Worker {
    WorkerSetup setup;
    pthread_t thread;
    pthread_mutex_t mutex; // guards request, status, model and stops
    pthread_cond_t changed;
    WorkerRequest request;
    WorkerStatus status;
    Model *model;
    bool stops;
    // Only the worker thread uses the members below.
    Session session;
    Model *traced;         // the session's model, with a reference; may be NULL
    PictureResult drawn;   // result of the latest picture
    double sample_seconds; // tracing time per sample
    bool has_measured;     // sample_seconds is measured, not guessed
    double woken;          // clock time of the latest status update
};

typedef enum { JOB_STOP, JOB_LOAD, JOB_TAKE, JOB_EXPLAIN, JOB_ENCODE, JOB_PASS } JobKind;

typedef struct {
    JobKind kind;
    WorkerRequest request; // the request when the job was chosen
    Pass pass;
} Job;

// Returns the settings of the requested picture. The tile size is a placeholder of one pixel, which
// plan_pass replaces.
RenderSettings worker_settings(const Worker *worker, const WorkerRequest *request);

// Each function runs one kind of job. The first load also opens the device.
void jobs_load(Worker *worker, const Job *job);
void jobs_take(Worker *worker, const Job *job);
void jobs_explain(Worker *worker, const Job *job);
void jobs_encode(Worker *worker, const Job *job);
void jobs_trace(Worker *worker, const Job *job);
