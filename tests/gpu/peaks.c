// SPDX-License-Identifier: MIT
// Measures how many bytes a device reads in a second, and how many floating-point operations it
// computes. Prints both numbers as JSON. Usage: gpu_peaks PEAKS.cl [DEVICE]
#include "base/clock.h"
#include "base/file.h"
#include "device/buffer.h"

#include <stdio.h>
#include <stdlib.h>

#define BYTES  (256u << 20)
#define LOOPS  16384u
#define RUNS   4
#define GROUP  64u
#define ROUNDS 5
// A CPU does less in parallel than a GPU, so it reads and computes only an eighth.
#define CPU_SHARE 8

typedef struct {
    Device device;
    cl_program program;
    cl_mem values, sums;
    size_t items;
} Bench;

static void require(bool ok, const char *what, const Error *error)
{
    if (!ok) {
        fprintf(stderr, "gpu_peaks: %s: %s\n", what, error->text);
        exit(1);
    }
}

static void open_bench(Bench *bench, const char *path, const char *device)
{
    Error error = {0};
    File file = {0};
    require(device_open(&bench->device, device, &error), "device", &error);
    require(file_read(&file, path, &error), "kernels", &error);
    const char *text = (const char *)file.bytes;
    bench->program = clCreateProgramWithSource(bench->device.context, 1, &text, &file.size, NULL);
    cl_int status =
        clBuildProgram(bench->program, 1, &bench->device.id, "-cl-std=CL1.2", NULL, NULL);
    require(cl_succeeded(status, "build the kernels", &error), "kernels", &error);
    bench->items = (size_t)bench->device.facts.compute_units * 4096;
    require(
        buffer_make(&bench->device, NULL, BYTES, &bench->values, &error) &&
            buffer_make(&bench->device, NULL, bench->items * sizeof(float), &bench->sums, &error),
        "memory", &error);
    const cl_float zero = 0;
    status = clEnqueueFillBuffer(bench->device.queue, bench->values, &zero, sizeof zero, 0, BYTES,
                                 0, NULL, NULL);
    require(cl_succeeded(status, "fill a buffer", &error), "memory", &error);
    file_free(&file);
}

// Returns the shortest time of a kernel in seconds. The first round does not count.
static double shortest(const Bench *bench, const char *name, cl_uint count)
{
    Error error = {0};
    double best = 0;
    const size_t group = GROUP;
    cl_kernel kernel = clCreateKernel(bench->program, name, NULL);
    clSetKernelArg(kernel, 0, sizeof(cl_mem), &bench->values);
    clSetKernelArg(kernel, 1, sizeof count, &count);
    clSetKernelArg(kernel, 2, sizeof(cl_mem), &bench->sums);
    for (int round = 0; round <= ROUNDS; round++) {
        const double start = clock_seconds();
        cl_int status = CL_SUCCESS;
        for (int run = 0; run < RUNS && status == CL_SUCCESS; run++)
            status = clEnqueueNDRangeKernel(bench->device.queue, kernel, 1, NULL, &bench->items,
                                            &group, 0, NULL, NULL);
        if (status == CL_SUCCESS)
            status = clFinish(bench->device.queue);
        require(cl_succeeded(status, "run a kernel", &error), name, &error);
        const double seconds = (clock_seconds() - start) / RUNS;
        best = round <= 1 || seconds < best ? seconds : best;
    }
    clReleaseKernel(kernel);
    return best;
}

int main(int count, char **words)
{
    Bench bench = {0};
    if (count < 2)
        return 2;
    open_bench(&bench, words[1], count > 2 ? words[2] : NULL);
    const cl_uint share = bench.device.is_cpu ? CPU_SHARE : 1;
    const cl_uint bytes = BYTES / share, loops = LOOPS / share;
    const double reading = shortest(&bench, "read_memory", bytes / 16);
    const double computing = shortest(&bench, "multiply_and_add", loops);
    printf("{\"bytes_per_second\": %.4g, \"operations_per_second\": %.4g}\n", bytes / reading,
           16.0 * loops * (double)bench.items / computing);
    buffer_release(&bench.values);
    buffer_release(&bench.sums);
    clReleaseProgram(bench.program);
    device_close(&bench.device);
    return 0;
}
