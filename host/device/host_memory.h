// SPDX-License-Identifier: MIT
// Devices copy their results into HostMemory. For devices that are not CPUs, the OpenCL
// implementation allocates the memory, because copies into ordinary memory are slower and make the
// host wait. The implementation locks the pages of this memory. On an NVIDIA H200, this takes 0.4
// ms for each megabyte, and unlocking takes 0.1 ms. A pool therefore keeps the most recently freed
// memory for reuse.
#pragma once

#include "device/cl_status.h"

typedef struct HostPool HostPool;

typedef struct {
    void *data;
    size_t size;    // bytes
    HostPool *pool; // borrowed; NULL if the memory is ordinary
    cl_mem buffer;  // NULL without a pool
} HostMemory;

// Makes an empty pool. Returns NULL on failure. The context and the queue must outlive the pool.
HostPool *host_pool_make(cl_context context, cl_command_queue queue, Error *error);

// `pool` may be NULL. None of its memory may be in use.
void host_pool_free(HostPool *pool);

// Allocates `size` uninitialized bytes. If `pool` is NULL, the memory is ordinary. After a failure,
// host_memory_free does nothing.
bool host_memory_make(HostMemory *memory, HostPool *pool, size_t size, Error *error);

// Frees the memory or gives it back to its pool. No copy into the memory may be in flight.
void host_memory_free(HostMemory *memory);
