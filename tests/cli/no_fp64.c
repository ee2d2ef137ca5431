// SPDX-License-Identifier: MIT
// If preloaded, this library makes every OpenCL device report that CL_DEVICE_DOUBLE_FP_CONFIG is 0,
// as a device without double arithmetic does.
#include <CL/cl.h>
#include <dlfcn.h>

typedef cl_int GetDeviceInfo(cl_device_id, cl_device_info, size_t, void *, size_t *);

cl_int clGetDeviceInfo(cl_device_id device, cl_device_info what, size_t size, void *value,
                       size_t *written)
{
    GetDeviceInfo *real;
    *(void **)&real = dlsym(RTLD_NEXT, "clGetDeviceInfo");
    const cl_int status = real(device, what, size, value, written);
    if (status == CL_SUCCESS && what == CL_DEVICE_DOUBLE_FP_CONFIG && size >= sizeof(cl_ulong))
        *(cl_ulong *)value = 0;
    return status;
}
