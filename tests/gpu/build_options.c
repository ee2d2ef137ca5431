// SPDX-License-Identifier: MIT
// If preloaded, this library appends CLRT_BUILD_OPTIONS to the compiler options of every program.
// tools/gpu measures the effect of drivers' options by this library.
#include <CL/cl.h>
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>

cl_int clBuildProgram(cl_program program, cl_uint count, const cl_device_id *devices,
                      const char *options, void(CL_CALLBACK *notify)(cl_program, void *),
                      void *user)
{
    char all[4096];
    const char *more = getenv("CLRT_BUILD_OPTIONS");
    __typeof__(clBuildProgram) *real;
    *(void **)&real = dlsym(RTLD_NEXT, "clBuildProgram");
    const int length = snprintf(all, sizeof all, "%s %s", options != NULL ? options : "",
                                more != NULL ? more : "");
    if (length < 0 || (size_t)length >= sizeof all)
        return CL_INVALID_BUILD_OPTIONS;
    return real(program, count, devices, all, notify, user);
}
