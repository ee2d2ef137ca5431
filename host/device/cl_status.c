// SPDX-License-Identifier: MIT
// Names OpenCL's error codes.
#include "device/cl_status.h"

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
