// SPDX-License-Identifier: MIT
// A thread pool. Each call of crew_run starts a generation of tasks. Idle threads first poll for
// the next generation, because calls often follow each other closely, and then sleep.
#include "base/parallel.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdlib.h>

#define THREADS_MAX    256
#define LOOKS_FOR_WORK 200 // polls before a thread sleeps, about 0.1 ms

typedef struct {
    Crew *crew;
    pthread_t thread;
    uint32_t number; // from 1; the caller's thread has number 0
} Worker;

struct Crew {
    CrewWork *work;
    void *context;
    uint32_t count;
    atomic_uint next_task;
    atomic_uint generation;
    atomic_uint busy; // workers that have not finished the generation
    atomic_bool closing;
    pthread_mutex_t mutex; // protects sleeping and waking
    pthread_cond_t wake;
    uint32_t worker_count; // the caller's thread does not count
    Worker workers[];
};

static void take_tasks(Crew *crew, uint32_t worker)
{
    for (;;) {
        const uint32_t task = atomic_fetch_add(&crew->next_task, 1);
        if (task >= crew->count)
            return;
        crew->work(crew->context, task, worker);
    }
}

// Waits for the generation after `known` and returns its number.
static uint32_t await_generation(Crew *crew, uint32_t known)
{
    for (int look = 0; look < LOOKS_FOR_WORK; look++) {
        if (atomic_load(&crew->generation) != known)
            return known + 1;
        sched_yield();
    }
    pthread_mutex_lock(&crew->mutex);
    while (atomic_load(&crew->generation) == known)
        pthread_cond_wait(&crew->wake, &crew->mutex);
    pthread_mutex_unlock(&crew->mutex);
    return known + 1;
}

static void *live(void *context)
{
    Worker *worker = context;
    Crew *crew = worker->crew;
    uint32_t generation = 0;
    for (;;) {
        generation = await_generation(crew, generation);
        if (atomic_load(&crew->closing))
            return NULL;
        take_tasks(crew, worker->number);
        atomic_fetch_sub(&crew->busy, 1);
    }
}

static void begin_generation(Crew *crew)
{
    atomic_store(&crew->busy, crew->worker_count);
    pthread_mutex_lock(&crew->mutex);
    atomic_fetch_add(&crew->generation, 1);
    pthread_cond_broadcast(&crew->wake);
    pthread_mutex_unlock(&crew->mutex);
}

Crew *crew_open(uint32_t threads)
{
    if (threads <= 1)
        return NULL;
    const uint32_t others = (threads < THREADS_MAX ? threads : THREADS_MAX) - 1;
    Crew *crew = calloc(1, sizeof *crew + others * sizeof crew->workers[0]);
    if (crew == NULL)
        return NULL;
    pthread_mutex_init(&crew->mutex, NULL);
    pthread_cond_init(&crew->wake, NULL);
    for (uint32_t i = 0; i < others; i++) {
        crew->workers[i].crew = crew;
        crew->workers[i].number = i + 1;
        if (pthread_create(&crew->workers[i].thread, NULL, live, &crew->workers[i]) != 0)
            break;
        crew->worker_count++;
    }
    return crew;
}

void crew_close(Crew *crew)
{
    if (crew == NULL)
        return;
    atomic_store(&crew->closing, true);
    begin_generation(crew);
    for (uint32_t i = 0; i < crew->worker_count; i++)
        pthread_join(crew->workers[i].thread, NULL);
    pthread_cond_destroy(&crew->wake);
    pthread_mutex_destroy(&crew->mutex);
    free(crew);
}

uint32_t crew_size(const Crew *crew)
{
    return crew == NULL ? 1 : crew->worker_count + 1;
}

void crew_run(Crew *crew, uint32_t count, CrewWork *work, void *context)
{
    if (crew == NULL || count <= 1) {
        for (uint32_t task = 0; task < count; task++)
            work(context, task, 0);
        return;
    }
    crew->work = work;
    crew->context = context;
    crew->count = count;
    atomic_store(&crew->next_task, 0);
    begin_generation(crew);
    take_tasks(crew, 0);
    while (atomic_load(&crew->busy) > 0)
        sched_yield();
}
