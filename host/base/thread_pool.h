// SPDX-License-Identifier: MIT
// A thread pool for numbered tasks. The assignment of tasks to threads varies, so a task's result
// must depend on its number alone.
#pragma once

#include <stdint.h>

typedef struct ThreadPool ThreadPool;

typedef void ThreadPoolWork(void *context, uint32_t task);

// Opens a pool of up to `threads` threads, including the caller's thread. With 0, the pool has a
// thread for each processor that the process may use. All other threads start when the pool first
// has several tasks. The pool has fewer threads if the system cannot start them. NULL is a valid
// pool that consists of the caller's thread alone.
ThreadPool *thread_pool_open(uint32_t threads);
void thread_pool_close(ThreadPool *pool);

// Calls `work` for tasks 0 to `count` - 1, starts them in ascending order, and returns when all are
// finished. `work` must not use the pool.
void thread_pool_run(ThreadPool *pool, uint32_t count, ThreadPoolWork *work, void *context);

// Processes the elements from `first` to `end` - 1.
typedef void ThreadPoolPart(void *context, uint32_t first, uint32_t end);

// Divides the elements 0 to `count` - 1 into ranges of `part` elements. The last range may be
// shorter. Calls `work` for each range, as thread_pool_run does for tasks.
void thread_pool_share(ThreadPool *pool, uint32_t count, uint32_t part, ThreadPoolPart *work,
                       void *context);

// The usual value of `part`.
#define CHUNK_ELEMENTS 16384

// Returns the number of ranges of `part` elements, including a shorter last range.
static inline uint32_t range_count(uint32_t elements, uint32_t part)
{
    return elements / part + (elements % part > 0);
}
