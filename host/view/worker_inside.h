// SPDX-License-Identifier: MIT
// Shared by the worker's own files: worker.c chooses jobs, jobs.c runs them.
#pragma once

#include "view/worker.h"

struct Worker {
    WorkerSetup setup;
    pthread_t thread;
    pthread_mutex_t mutex; // guards the next five members
    pthread_cond_t changed;
    WorkerRequest request;
    WorkerStatus status;
    Model *model;
    bool stops;
    // Used only by the worker thread.
    Tracer tracer;
    double sample_seconds; // per sample
    bool has_measured;     // sample_seconds is measured, not guessed
    double woken;
};

typedef enum { JOB_STOP, JOB_LOAD, JOB_TAKE, JOB_ENCODE, JOB_PASS } JobKind;

typedef struct {
    JobKind kind;
    WorkerRequest request; // at the time of the choice
    Pass pass;
} Job;

// The jobs.  jobs_begin also opens the device; it returns false if nothing can be displayed.
bool jobs_begin(Worker *worker);
void jobs_load(Worker *worker, const Job *job);
void jobs_take(Worker *worker, const Job *job);
void jobs_encode(Worker *worker, const Job *job);
void jobs_trace(Worker *worker, const Job *job);
