// SPDX-License-Identifier: MIT
// OpenCL has no empty buffers, so the buffer of an empty array has 64 bytes.
#include "device/buffer.h"

#include "device/device.h"

#include <stdlib.h>

bool buffer_upload(const Device *device, const FlatArray *array, cl_mem *buffer, Error *error)
{
    static const _Alignas(64) char nothing[64];
    const size_t size = array->bytes;
    if (size > device->facts.largest_allocation)
        return error_set(error, "the scene needs a buffer of %zu bytes; %s offers at most %llu",
                         size, device->facts.name,
                         (unsigned long long)device->facts.largest_allocation);
    const cl_mem_flags origin = device->shares_memory ? CL_MEM_USE_HOST_PTR : CL_MEM_COPY_HOST_PTR;
    void *source = (void *)(size > 0 ? array->data : nothing);
    cl_int status;
    *buffer = clCreateBuffer(device->context, CL_MEM_READ_ONLY | origin,
                             size > 0 ? size : sizeof nothing, source, &status);
    return cl_succeeded(status, "upload the scene", error);
}

bool buffer_make(const Device *device, size_t size, cl_mem *buffer, Error *error)
{
    cl_int status;
    *buffer = clCreateBuffer(device->context, CL_MEM_READ_WRITE, size, NULL, &status);
    return cl_succeeded(status, "allocate a buffer", error);
}

bool buffer_read(const Device *device, cl_mem buffer, void *target, size_t size, Error *error)
{
    return cl_succeeded(
        clEnqueueReadBuffer(device->queue, buffer, CL_TRUE, 0, size, target, 0, NULL, NULL),
        "read results back", error);
}

static bool map(SharedArray *array, Error *error)
{
    cl_int status;
    array->data =
        clEnqueueMapBuffer(array->device->queue, array->buffer, CL_TRUE, CL_MAP_READ | CL_MAP_WRITE,
                           0, array->size, 0, NULL, NULL, &status);
    return cl_succeeded(status, "map a buffer", error);
}

static bool unmap(const SharedArray *array, Error *error)
{
    return cl_succeeded(
        clEnqueueUnmapMemObject(array->device->queue, array->buffer, array->data, 0, NULL, NULL),
        "unmap a buffer", error);
}

bool shared_array_make(SharedArray *array, const Device *device, size_t size, Error *error)
{
    *array = (SharedArray){.device = device, .size = size};
    if (!buffer_make(device, size, &array->buffer, error))
        return false;
    if (device->shares_memory)
        map(array, error);
    else
        array->data = memory_raw(size, 1, error);
    if (array->data == NULL)
        buffer_release(&array->buffer);
    return array->data != NULL;
}

bool shared_array_send(const SharedArray *array, size_t used, Error *error)
{
    if (array->device->shares_memory)
        return unmap(array, error);
    return used == 0 ||
           cl_succeeded(clEnqueueWriteBuffer(array->device->queue, array->buffer, CL_FALSE, 0, used,
                                             array->data, 0, NULL, NULL),
                        "write a buffer", error);
}

bool shared_array_receive(SharedArray *array, size_t used, Error *error)
{
    if (!array->device->shares_memory)
        return used == 0 || buffer_read(array->device, array->buffer, array->data, used, error);
    if (map(array, error))
        return true;
    buffer_release(&array->buffer);
    return false;
}

void shared_array_free(SharedArray *array)
{
    Error ignored;
    if (array->buffer != NULL && array->device->shares_memory) {
        unmap(array, &ignored);
        clFinish(array->device->queue);
    } else {
        free(array->data);
    }
    buffer_release(&array->buffer);
    *array = (SharedArray){0};
}

void buffer_release(cl_mem *buffer)
{
    if (*buffer != NULL)
        clReleaseMemObject(*buffer);
    *buffer = NULL;
}
