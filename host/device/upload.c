// SPDX-License-Identifier: MIT
// OpenCL has no empty buffers, so an empty array gets a few bytes.
#include "device/upload.h"

#include "device/cl_error.h"

bool upload_array(const Device *device, const void *data, size_t size, cl_mem *buffer, Error *error)
{
    static const _Alignas(64) char nothing[64];
    if (size > device->largest_allocation)
        return error_set(error, "the scene needs a buffer of %zu bytes and %s offers %llu at most",
                         size, device->name, (unsigned long long)device->largest_allocation);
    const cl_mem_flags origin = device->shares_memory ? CL_MEM_USE_HOST_PTR : CL_MEM_COPY_HOST_PTR;
    void *source = (void *)(size > 0 ? data : nothing);
    cl_int status;
    *buffer = clCreateBuffer(device->context, CL_MEM_READ_ONLY | origin,
                             size > 0 ? size : sizeof nothing, source, &status);
    return cl_succeeded(status, "upload the scene", error);
}
