// SPDX-License-Identifier: MIT
// Maps buffers that the OpenCL implementation allocates on the host.
#include "device/host_memory.h"

#include "base/array.h"

#include <stdlib.h>
#include <string.h>

// The number of kept buffers: two outputs for each of three launches in flight.
#define KEPT 6

struct HostPool {
    cl_context context;
    cl_command_queue queue;
    HostMemory kept[KEPT]; // the most recently freed memory comes first
};

HostPool *host_pool_make(cl_context context, cl_command_queue queue, Error *error)
{
    HostPool *pool = memory_zeroed(1, sizeof *pool, error);
    if (pool != NULL)
        *pool = (HostPool){.context = context, .queue = queue};
    return pool;
}

static void unmap(HostMemory *memory)
{
    if (memory->buffer == NULL)
        return;
    clEnqueueUnmapMemObject(memory->pool->queue, memory->buffer, memory->data, 0, NULL, NULL);
    clFinish(memory->pool->queue);
    clReleaseMemObject(memory->buffer);
}

void host_pool_free(HostPool *pool)
{
    for (int i = 0; pool != NULL && i < KEPT; i++)
        unmap(&pool->kept[i]);
    free(pool);
}

static bool map(HostMemory *memory, const HostPool *pool, Error *error)
{
    cl_int status;
    memory->buffer = clCreateBuffer(pool->context, CL_MEM_READ_WRITE | CL_MEM_ALLOC_HOST_PTR,
                                    memory->size, NULL, &status);
    if (!cl_succeeded(status, "allocate a buffer", error))
        return false;
    memory->data =
        clEnqueueMapBuffer(pool->queue, memory->buffer, CL_TRUE, CL_MAP_READ | CL_MAP_WRITE, 0,
                           memory->size, 0, NULL, NULL, &status);
    if (status != CL_SUCCESS) {
        clReleaseMemObject(memory->buffer);
        memory->buffer = NULL;
    }
    return cl_succeeded(status, "map a buffer", error);
}

static bool take_kept(HostMemory *memory, HostPool *pool)
{
    for (int i = 0; i < KEPT; i++)
        if (pool->kept[i].size == memory->size) {
            *memory = pool->kept[i];
            pool->kept[i] = (HostMemory){0};
            return true;
        }
    return false;
}

bool host_memory_make(HostMemory *memory, HostPool *pool, size_t size, Error *error)
{
    *memory = (HostMemory){.size = size, .pool = pool};
    if (pool != NULL)
        return take_kept(memory, pool) || map(memory, pool, error);
    memory->data = memory_raw(size, 1, error);
    return memory->data != NULL;
}

static void keep(const HostMemory *memory)
{
    HostMemory *kept = memory->pool->kept;
    unmap(&kept[KEPT - 1]);
    memmove(kept + 1, kept, (KEPT - 1) * sizeof *kept);
    kept[0] = *memory;
}

void host_memory_free(HostMemory *memory)
{
    if (memory->buffer != NULL)
        keep(memory);
    else if (memory->pool == NULL)
        free(memory->data);
    *memory = (HostMemory){0};
}
