// SPDX-License-Identifier: MIT
// A thread pool for numbered tasks. The assignment of tasks to threads varies, so a task's result
// must depend on its number alone.
#pragma once

#include <stdint.h>

typedef struct Crew Crew;

// Runs one task. The worker's number is less than crew_size and selects per-thread memory.
typedef void CrewWork(void *context, uint32_t task, uint32_t worker);

// Opens a pool of up to `threads` threads, including the caller's. The system may grant fewer. NULL
// is a valid pool that consists of the caller's thread alone.
Crew *crew_open(uint32_t threads);
void crew_close(Crew *crew);

uint32_t crew_size(const Crew *crew);

// Calls `work` for tasks 0 to count - 1, starts them in this order, and returns when all are
// finished. `work` must not use the pool.
void crew_run(Crew *crew, uint32_t count, CrewWork *work, void *context);

// The number of array elements in a chunk, which one task processes.
#define CHUNK_ELEMENTS 16384

static inline uint32_t chunk_count(uint32_t elements)
{
    return elements / CHUNK_ELEMENTS + (elements % CHUNK_ELEMENTS > 0);
}

// Returns the index after the chunk's last element. The first is chunk * CHUNK_ELEMENTS.
static inline uint32_t chunk_end(uint32_t chunk, uint32_t elements)
{
    const uint32_t first = chunk * CHUNK_ELEMENTS;
    return elements - first < CHUNK_ELEMENTS ? elements : first + CHUNK_ELEMENTS;
}
