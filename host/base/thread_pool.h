// SPDX-License-Identifier: MIT
// A thread pool for numbered tasks. The assignment of tasks to threads is random, so a task's
// result must depend on its number alone.
#pragma once

#include <stdint.h>

typedef struct ThreadPool ThreadPool;

// Runs one task. The worker's number, below thread_pool_size, selects per-thread memory.
typedef void ThreadPoolWork(void *context, uint32_t task, uint32_t worker);

// Opens a pool of `threads` threads, including the caller's. NULL is a pool of the caller alone:
// for one thread, and if the system grants none.
ThreadPool *thread_pool_open(uint32_t threads);
void thread_pool_close(ThreadPool *pool);

uint32_t thread_pool_size(const ThreadPool *pool);

// Calls work once for each task below count and returns when all are done. Low numbers start
// first. work must not use the pool itself.
void thread_pool_run(ThreadPool *pool, uint32_t count, ThreadPoolWork *work, void *context);

// Number of elements in a chunk, the unit of shared work.
#define CHUNK_ELEMENTS 16384

static inline uint32_t chunk_count(uint32_t elements)
{
    return elements / CHUNK_ELEMENTS + (elements % CHUNK_ELEMENTS > 0);
}

// Returns one past the last element of a chunk. A chunk begins at CHUNK_ELEMENTS times its number.
static inline uint32_t chunk_end(uint32_t chunk, uint32_t elements)
{
    const uint32_t first = chunk * CHUNK_ELEMENTS;
    return elements - first < CHUNK_ELEMENTS ? elements : first + CHUNK_ELEMENTS;
}
