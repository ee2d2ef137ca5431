// SPDX-License-Identifier: MIT
// Each call of thread_pool_run with several tasks is a generation. The pool's workers and the
// caller's thread take task numbers from a common counter until none is left. The call returns when
// no worker is busy.
//
// Generations often follow each other closely, and waking a thread takes long. Idle workers
// therefore first poll for the next generation, and then sleep.
#include "base/thread_pool.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdlib.h>

#define THREADS_MAX    256
#define LOOKS_FOR_WORK 200 // polls before a thread sleeps, about 0.1 ms

struct ThreadPool {
    ThreadPoolWork *work;
    void *context;
    uint32_t count;
    atomic_uint next_task;
    atomic_uint generation;
    atomic_uint busy; // workers that have not finished the generation
    atomic_bool closing;
    pthread_mutex_t mutex; // protects sleeping and waking
    pthread_cond_t wake;
    uint32_t worker_count; // excludes the caller's thread
    pthread_t workers[];
};

static void take_tasks(ThreadPool *pool)
{
    for (;;) {
        const uint32_t task = atomic_fetch_add(&pool->next_task, 1);
        if (task >= pool->count)
            return;
        pool->work(pool->context, task);
    }
}

// Waits until the generation's number differs from `known`, and returns the new number.
static uint32_t await_generation(ThreadPool *pool, uint32_t known)
{
    for (int look = 0; look < LOOKS_FOR_WORK; look++) {
        if (atomic_load(&pool->generation) != known)
            return known + 1;
        sched_yield();
    }
    pthread_mutex_lock(&pool->mutex);
    while (atomic_load(&pool->generation) == known)
        pthread_cond_wait(&pool->wake, &pool->mutex);
    pthread_mutex_unlock(&pool->mutex);
    return known + 1;
}

static void *run_worker(void *context)
{
    ThreadPool *pool = context;
    uint32_t generation = 0;
    for (;;) {
        generation = await_generation(pool, generation);
        if (atomic_load(&pool->closing))
            return NULL;
        take_tasks(pool);
        atomic_fetch_sub(&pool->busy, 1);
    }
}

static void begin_generation(ThreadPool *pool)
{
    atomic_store(&pool->busy, pool->worker_count);
    pthread_mutex_lock(&pool->mutex);
    atomic_fetch_add(&pool->generation, 1);
    pthread_cond_broadcast(&pool->wake);
    pthread_mutex_unlock(&pool->mutex);
}

ThreadPool *thread_pool_open(uint32_t threads)
{
    if (threads <= 1)
        return NULL;
    const uint32_t others = (threads < THREADS_MAX ? threads : THREADS_MAX) - 1;
    ThreadPool *pool = calloc(1, sizeof *pool + others * sizeof pool->workers[0]);
    if (pool == NULL)
        return NULL;
    pthread_mutex_init(&pool->mutex, NULL);
    pthread_cond_init(&pool->wake, NULL);
    for (uint32_t i = 0; i < others; i++) {
        if (pthread_create(&pool->workers[i], NULL, run_worker, pool) != 0)
            break;
        pool->worker_count++;
    }
    return pool;
}

void thread_pool_close(ThreadPool *pool)
{
    if (pool == NULL)
        return;
    atomic_store(&pool->closing, true);
    begin_generation(pool);
    for (uint32_t i = 0; i < pool->worker_count; i++)
        pthread_join(pool->workers[i], NULL);
    pthread_cond_destroy(&pool->wake);
    pthread_mutex_destroy(&pool->mutex);
    free(pool);
}

void thread_pool_run(ThreadPool *pool, uint32_t count, ThreadPoolWork *work, void *context)
{
    if (pool == NULL || count <= 1) {
        for (uint32_t task = 0; task < count; task++)
            work(context, task);
        return;
    }
    pool->work = work;
    pool->context = context;
    pool->count = count;
    atomic_store(&pool->next_task, 0);
    begin_generation(pool);
    take_tasks(pool);
    while (atomic_load(&pool->busy) > 0)
        sched_yield();
}

typedef struct {
    ThreadPoolPart *work;
    void *context;
    uint32_t count, part;
} Ranges;

static void run_range(void *context, uint32_t task)
{
    const Ranges *ranges = context;
    const uint32_t first = task * ranges->part, left = ranges->count - first;
    ranges->work(ranges->context, first, first + (left < ranges->part ? left : ranges->part));
}

void thread_pool_share(ThreadPool *pool, uint32_t count, uint32_t part, ThreadPoolPart *work,
                       void *context)
{
    Ranges ranges = {work, context, count, part};
    thread_pool_run(pool, range_count(count, part), run_range, &ranges);
}
