// SPDX-License-Identifier: MIT
// If preloaded, this library makes the device fail as if it ran out of memory or were lost.
// CLRT_FAIL_NAME names an OpenCL function of this file. The function's first CLRT_FAIL_CALL - 1
// calls succeed, and all later calls fail. The text of CLRT_FIRST_LINES precedes the source of
// every OpenCL program. Macros in this text can make the device round wrongly. While the file
// CLRT_BUILD_WAITS exists, no program is built.
#include <CL/cl.h>
#include <dlfcn.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static atomic_long calls;

static bool fails(const char *name)
{
    const char *wanted = getenv("CLRT_FAIL_NAME"), *first = getenv("CLRT_FAIL_CALL");
    return wanted != NULL && first != NULL && strcmp(wanted, name) == 0 &&
           atomic_fetch_add(&calls, 1) + 1 >= atol(first);
}

cl_mem clCreateBuffer(cl_context context, cl_mem_flags flags, size_t size, void *host,
                      cl_int *status)
{
    cl_mem (*real)(cl_context, cl_mem_flags, size_t, void *, cl_int *);
    *(void **)&real = dlsym(RTLD_NEXT, "clCreateBuffer");
    if (!fails("clCreateBuffer"))
        return real(context, flags, size, host, status);
    if (status != NULL)
        *status = CL_MEM_OBJECT_ALLOCATION_FAILURE;
    return NULL;
}

cl_program clCreateProgramWithSource(cl_context context, cl_uint count, const char **texts,
                                     const size_t *lengths, cl_int *status)
{
    const char *all[9], *first = getenv("CLRT_FIRST_LINES");
    __typeof__(clCreateProgramWithSource) *real;
    *(void **)&real = dlsym(RTLD_NEXT, "clCreateProgramWithSource");
    if (first == NULL || count > 8 || lengths != NULL)
        return real(context, count, texts, lengths, status);
    all[0] = first;
    memcpy(all + 1, texts, count * sizeof *texts);
    return real(context, count + 1, all, NULL, status);
}

cl_context clCreateContext(const cl_context_properties *properties, cl_uint count,
                           const cl_device_id *devices,
                           void(CL_CALLBACK *notify)(const char *, const void *, size_t, void *),
                           void *context, cl_int *status)
{
    __typeof__(clCreateContext) *real;
    *(void **)&real = dlsym(RTLD_NEXT, "clCreateContext");
    if (!fails("clCreateContext"))
        return real(properties, count, devices, notify, context, status);
    if (status != NULL)
        *status = CL_OUT_OF_HOST_MEMORY;
    return NULL;
}

cl_int clEnqueueNDRangeKernel(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions,
                              const size_t *offset, const size_t *grid, const size_t *group,
                              cl_uint count, const cl_event *events, cl_event *event)
{
    cl_int (*real)(cl_command_queue, cl_kernel, cl_uint, const size_t *, const size_t *,
                   const size_t *, cl_uint, const cl_event *, cl_event *);
    *(void **)&real = dlsym(RTLD_NEXT, "clEnqueueNDRangeKernel");
    return fails("clEnqueueNDRangeKernel")
               ? CL_OUT_OF_RESOURCES
               : real(queue, kernel, dimensions, offset, grid, group, count, events, event);
}

cl_int clWaitForEvents(cl_uint count, const cl_event *events)
{
    cl_int (*real)(cl_uint, const cl_event *);
    *(void **)&real = dlsym(RTLD_NEXT, "clWaitForEvents");
    const cl_int status = real(count, events);
    return fails("clWaitForEvents") ? CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST : status;
}

cl_int clBuildProgram(cl_program program, cl_uint count, const cl_device_id *devices,
                      const char *options, void(CL_CALLBACK *notify)(cl_program, void *),
                      void *context)
{
    const char *file = getenv("CLRT_BUILD_WAITS");
    __typeof__(clBuildProgram) *real;
    *(void **)&real = dlsym(RTLD_NEXT, "clBuildProgram");
    while (file != NULL && access(file, F_OK) == 0)
        usleep(10000);
    return real(program, count, devices, options, notify, context);
}
