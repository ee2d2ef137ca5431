// SPDX-License-Identifier: MIT
// OpenCL has no empty buffers, so an empty array gets a few bytes.
#include "device/buffer.h"

#include "device/device.h"

bool upload_array(const Device *device, const FlatArray *array, cl_mem *buffer, Error *error)
{
    static const _Alignas(64) char nothing[64];
    const size_t size = array->bytes;
    if (size > device->largest_allocation)
        return error_set(error, "the scene needs a buffer of %zu bytes; %s offers at most %llu",
                         size, device->name, (unsigned long long)device->largest_allocation);
    const cl_mem_flags origin = device->shares_memory ? CL_MEM_USE_HOST_PTR : CL_MEM_COPY_HOST_PTR;
    void *source = (void *)(size > 0 ? array->data : nothing);
    cl_int status;
    *buffer = clCreateBuffer(device->context, CL_MEM_READ_ONLY | origin,
                             size > 0 ? size : sizeof nothing, source, &status);
    return cl_succeeded(status, "upload the scene", error);
}

bool device_buffer(const Device *device, size_t size, cl_mem *buffer, Error *error)
{
    cl_int status;
    *buffer = clCreateBuffer(device->context, CL_MEM_READ_WRITE, size, NULL, &status);
    return cl_succeeded(status, "allocate a buffer", error);
}

bool device_read(const Device *device, cl_mem buffer, void *target, size_t size, Error *error)
{
    return cl_succeeded(
        clEnqueueReadBuffer(device->queue, buffer, CL_TRUE, 0, size, target, 0, NULL, NULL),
        "read results back", error);
}

void device_release(cl_mem *buffer)
{
    if (*buffer != NULL)
        clReleaseMemObject(*buffer);
    *buffer = NULL;
}

void device_release_kernel(cl_kernel *kernel)
{
    if (*kernel != NULL)
        clReleaseKernel(*kernel);
    *kernel = NULL;
}

const char *cl_error_name(cl_int status)
{
#define NAMED(code)                                                                                \
    {                                                                                              \
        code, #code                                                                                \
    }
    static const struct {
        cl_int status;
        const char *name;
    } names[] = {
        NAMED(CL_DEVICE_NOT_FOUND),
        NAMED(CL_DEVICE_NOT_AVAILABLE),
        NAMED(CL_COMPILER_NOT_AVAILABLE),
        NAMED(CL_MEM_OBJECT_ALLOCATION_FAILURE),
        NAMED(CL_OUT_OF_RESOURCES),
        NAMED(CL_OUT_OF_HOST_MEMORY),
        NAMED(CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST),
        NAMED(CL_BUILD_PROGRAM_FAILURE),
        NAMED(CL_INVALID_VALUE),
        NAMED(CL_INVALID_DEVICE),
        NAMED(CL_INVALID_BINARY),
        NAMED(CL_INVALID_BUILD_OPTIONS),
        NAMED(CL_INVALID_PROGRAM),
        NAMED(CL_INVALID_KERNEL_NAME),
        NAMED(CL_INVALID_KERNEL_ARGS),
        NAMED(CL_INVALID_WORK_GROUP_SIZE),
        NAMED(CL_INVALID_WORK_ITEM_SIZE),
        NAMED(CL_INVALID_BUFFER_SIZE),
        NAMED(CL_INVALID_GLOBAL_WORK_SIZE),
        {-1001, "CL_PLATFORM_NOT_FOUND_KHR"},
    };
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        if (names[i].status == status)
            return names[i].name;
    return "an OpenCL error without a name";
}

bool cl_succeeded(cl_int status, const char *attempt, Error *error)
{
    if (status == CL_SUCCESS)
        return true;
    return error_set(error, "cannot %s: %s (%d)", attempt, cl_error_name(status), status);
}
