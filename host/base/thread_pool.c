// SPDX-License-Identifier: MIT
// Each call of thread_pool_run with several tasks begins a generation of tasks. The pool's workers
// and the caller's thread take tasks from a common counter until none is left. The call returns
// when all tasks are finished. It does not wait for workers that wake too late to take a task.
//
// Generations often follow each other closely, and waking a thread takes long. Idle workers
// therefore first poll for the next generation, and then sleep.
#include "base/thread_pool.h"

#include "base/processors.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdlib.h>

#define THREADS_MAX    256
#define LOOKS_FOR_WORK 200 // polls before a thread sleeps, about 0.1 ms

// Upper 32 bits: the number of the generation. Lower 32 bits: the number of its tasks not yet
// taken. A compare-and-swap covers both, so a late worker cannot take a task of a later generation.
typedef uint64_t PoolState;

struct ThreadPool {
    ThreadPoolWork *work;
    void *context;
    uint32_t count;
    _Atomic PoolState state;
    atomic_uint finished; // number of the generation's finished tasks
    atomic_bool closing;
    pthread_mutex_t mutex; // locked to begin a generation or to fall asleep
    pthread_cond_t wake;
    uint32_t threads;      // including the caller's thread; 0: not known yet
    uint32_t worker_count; // threads that have started
    pthread_t workers[THREADS_MAX];
};

static uint32_t generation_of(PoolState state)
{
    return (uint32_t)(state >> 32);
}

// Runs tasks of the generation until none is left. While a thread has a task, pool->work stays
// valid, because thread_pool_run waits for the task.
static void take_tasks(ThreadPool *pool, uint32_t generation)
{
    PoolState state = atomic_load(&pool->state);
    while (generation_of(state) == generation && (uint32_t)state > 0) {
        if (!atomic_compare_exchange_weak(&pool->state, &state, state - 1))
            continue;
        pool->work(pool->context, pool->count - (uint32_t)state);
        atomic_fetch_add(&pool->finished, 1);
        state = atomic_load(&pool->state);
    }
}

// Waits until the generation's number differs from `known`, and returns the new number.
static uint32_t await_generation(ThreadPool *pool, uint32_t known)
{
    uint32_t now = generation_of(atomic_load(&pool->state));
    for (int look = 0; look < LOOKS_FOR_WORK && now == known; look++) {
        sched_yield();
        now = generation_of(atomic_load(&pool->state));
    }
    if (now != known)
        return now;
    pthread_mutex_lock(&pool->mutex);
    while ((now = generation_of(atomic_load(&pool->state))) == known)
        pthread_cond_wait(&pool->wake, &pool->mutex);
    pthread_mutex_unlock(&pool->mutex);
    return now;
}

static void *run_worker(void *context)
{
    ThreadPool *pool = context;
    uint32_t generation = 0;
    while (!atomic_load(&pool->closing)) {
        take_tasks(pool, generation);
        generation = await_generation(pool, generation);
    }
    return NULL;
}

// Begins a generation of `count` tasks, and returns its number.
static uint32_t begin_generation(ThreadPool *pool, uint32_t count)
{
    const uint32_t generation = generation_of(atomic_load(&pool->state)) + 1;
    pthread_mutex_lock(&pool->mutex);
    atomic_store(&pool->state, (PoolState)generation << 32 | count);
    pthread_cond_broadcast(&pool->wake);
    pthread_mutex_unlock(&pool->mutex);
    return generation;
}

ThreadPool *thread_pool_open(uint32_t threads)
{
    ThreadPool *pool = threads == 1 ? NULL : calloc(1, sizeof *pool);
    if (pool == NULL)
        return NULL;
    pthread_mutex_init(&pool->mutex, NULL);
    pthread_cond_init(&pool->wake, NULL);
    pool->threads = threads < THREADS_MAX ? threads : THREADS_MAX;
    return pool;
}

// Starts the threads that are not running. If the system refuses a thread, the pool stays smaller.
static void start_workers(ThreadPool *pool)
{
    if (pool->threads == 0) {
        const uint32_t usable = processors_usable();
        pool->threads = usable < THREADS_MAX ? usable : THREADS_MAX;
    }
    while (pool->worker_count + 1 < pool->threads &&
           pthread_create(&pool->workers[pool->worker_count], NULL, run_worker, pool) == 0)
        pool->worker_count++;
    pool->threads = pool->worker_count + 1;
}

void thread_pool_close(ThreadPool *pool)
{
    if (pool == NULL)
        return;
    atomic_store(&pool->closing, true);
    begin_generation(pool, 0);
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
    start_workers(pool);
    pool->work = work;
    pool->context = context;
    pool->count = count;
    atomic_store(&pool->finished, 0);
    take_tasks(pool, begin_generation(pool, count));
    while (atomic_load(&pool->finished) < count)
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
