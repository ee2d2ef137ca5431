// SPDX-License-Identifier: MIT
// Reads device code from the source tree and appends it to the kernels.
#include "kernel/probe.h"

#include "base/file.h"

#include <stdio.h>

// The embedded sources of kernels/certify.cl, for probes in fp64, and of kernels/samples.cl.
extern const char certify_source[], samples_source[];

static bool probe_open(Probe *probe, const char *path, ClrtPrecision precision, Error *error)
{
    File file = {0};
    char source[1 << 18];
    *probe = (Probe){0};
    bool ok = file_read(&file, path, error) && device_open(&probe->device, NULL, error);
    snprintf(source, sizeof source, "%s\n%s",
             precision == CLRT_FP64 ? certify_source : samples_source,
             ok ? (const char *)file.bytes : "");
    const KernelEntry entry = {.source = source};
    const ProgramSource program = {.device = &probe->device,
                                   .entry = &entry,
                                   .choice = {FAMILY_RAY, NODES_PAIR, 0, precision},
                                   .traits = traits_general((SceneTraits){0})};
    ok = ok && program_build(&probe->program, &program, error);
    file_free(&file);
    return ok;
}

int probe_begin(Probe *probe, const char *path, ClrtPrecision precision)
{
    Error error = {0};
    if (probe_open(probe, path, precision, &error))
        return 0;
    fprintf(stderr, "%s\n", error.text);
    return 1;
}

void probe_close(Probe *probe)
{
    program_free(&probe->program);
    device_close(&probe->device);
}

bool probe_run(const Probe *probe, const char *kernel_name, const ProbeInput inputs[2],
               size_t items, ProbeInput output)
{
    cl_int status;
    cl_mem buffers[3] = {0};
    cl_uint count = 0;
    cl_context context = probe->device.context;
    cl_kernel kernel = clCreateKernel(probe->program.handle, kernel_name, &status);
    for (; count < 2 && inputs[count].size > 0; count++) {
        buffers[count] = clCreateBuffer(context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR,
                                        inputs[count].size, (void *)inputs[count].data, NULL);
        clSetKernelArg(kernel, count, sizeof(cl_mem), &buffers[count]);
    }
    buffers[count] = clCreateBuffer(context, CL_MEM_READ_WRITE, output.size, NULL, NULL);
    clSetKernelArg(kernel, count, sizeof(cl_mem), &buffers[count]);
    status =
        clEnqueueNDRangeKernel(probe->device.queue, kernel, 1, NULL, &items, NULL, 0, NULL, NULL);
    if (status == CL_SUCCESS)
        status = clEnqueueReadBuffer(probe->device.queue, buffers[count], CL_TRUE, 0, output.size,
                                     (void *)output.data, 0, NULL, NULL);
    for (cl_uint i = 0; i <= count; i++)
        clReleaseMemObject(buffers[i]);
    clReleaseKernel(kernel);
    return status == CL_SUCCESS;
}
