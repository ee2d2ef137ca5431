// SPDX-License-Identifier: MIT
// OpenCL has no empty buffers, so the buffer of an empty array has 64 bytes.
#include "device/buffer.h"

#include "device/device.h"

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

bool buffer_make(const Device *device, void *data, size_t size, cl_mem *buffer, Error *error)
{
    const bool in_place = data != NULL && device->shares_memory;
    cl_int status;
    *buffer =
        clCreateBuffer(device->context, CL_MEM_READ_WRITE | (in_place ? CL_MEM_USE_HOST_PTR : 0),
                       size, in_place ? data : NULL, &status);
    return cl_succeeded(status, "allocate a buffer", error);
}

bool buffer_read(const Device *device, cl_mem buffer, void *target, size_t size, Error *error)
{
    return cl_succeeded(
        clEnqueueReadBuffer(device->queue, buffer, CL_TRUE, 0, size, target, 0, NULL, NULL),
        "read results back", error);
}

void buffer_release(cl_mem *buffer)
{
    if (*buffer != NULL)
        clReleaseMemObject(*buffer);
    *buffer = NULL;
}
