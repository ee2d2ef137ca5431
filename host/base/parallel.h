// SPDX-License-Identifier: MIT
// Threads that share out numbered tasks.  Who does which task is a matter of chance, so a task's
// result must depend on its number alone.
#pragma once

#include <stdint.h>

typedef struct Crew Crew;

// The worker's number, below crew_size, is for memory that each has of its own.
typedef void CrewWork(void *context, uint32_t task, uint32_t worker);

// A crew of that many threads, the caller's among them.  NULL is the caller alone: for one thread,
// and where the system grants none.
Crew *crew_open(uint32_t threads);
void crew_close(Crew *crew);

uint32_t crew_size(const Crew *crew);

// Calls work once for each task below count and returns when all are done.  Low numbers start
// first.  Work may not use the crew itself.
void crew_run(Crew *crew, uint32_t count, CrewWork *work, void *context);

// Elements that are shared out in chunks.
#define CHUNK_ELEMENTS 16384

static inline uint32_t chunk_count(uint32_t elements)
{
    return elements / CHUNK_ELEMENTS + (elements % CHUNK_ELEMENTS > 0);
}

// One past the last element of a chunk, which begins at CHUNK_ELEMENTS times its number.
static inline uint32_t chunk_end(uint32_t chunk, uint32_t elements)
{
    const uint32_t first = chunk * CHUNK_ELEMENTS;
    return elements - first < CHUNK_ELEMENTS ? elements : first + CHUNK_ELEMENTS;
}
