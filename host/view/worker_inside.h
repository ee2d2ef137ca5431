// SPDX-License-Identifier: MIT
// What the worker's own files share: worker.c chooses jobs, jobs.c does them.
#pragma once

#include "view/worker.h"

struct Worker {
    WorkerSetup setup;
    pthread_t thread;
    pthread_mutex_t mutex; // over the next five
    pthread_cond_t changed;
    WorkerRequest request;
    WorkerStatus status;
    Model *model;
    bool stops;
    // The thread's own:
    Tracer tracer;
    double sample_seconds; // that tracing one takes
    bool has_measured;     // it is no guess
    double woken;
};

typedef enum { JOB_STOP, JOB_LOAD, JOB_TAKE, JOB_ENCODE, JOB_PASS } JobKind;

typedef struct {
    JobKind kind;
    WorkerRequest request; // as it was when the job was chosen
    Pass pass;
} Job;

// The jobs.  The first one opens the device, too, and is false where nothing can be shown.
bool jobs_begin(Worker *worker);
void jobs_load(Worker *worker, const Job *job);
void jobs_take(Worker *worker, const Job *job);
void jobs_encode(Worker *worker, const Job *job);
void jobs_trace(Worker *worker, const Job *job);
