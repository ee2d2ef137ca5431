// SPDX-License-Identifier: MIT
// A set makes each program and each kernel at most once. A process has few kernels, so lookups
// compare all of them. PoCL compiles a kernel in the kernel's first run, so every first run is
// between cache_lock and cache_unlock.
#include "device/kernel.h"

#include "base/clock.h"
#include "device/buffer.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool is_for(const Kernel *kernel, const KernelSpec *spec)
{
    return kernel->entry == spec->entry &&
           memcmp(&kernel->choice, &spec->choice, sizeof spec->choice) == 0 &&
           memcmp(&kernel->traits, &spec->traits, sizeof spec->traits) == 0 &&
           memcmp(kernel->group, spec->group, sizeof spec->group) == 0;
}

static ProgramSource source_of(const KernelSet *set, const KernelSpec *spec)
{
    ProgramSource source = set->source;
    source.entry = spec->entry;
    source.choice = spec->choice;
    source.traits = spec->traits;
    return source;
}

static uint32_t group_info(const Kernel *kernel, cl_kernel_work_group_info name)
{
    size_t value = 0;
    clGetKernelWorkGroupInfo(kernel->handle, kernel->device->id, name, sizeof value, &value, NULL);
    return (uint32_t)value;
}

static bool check_group(const Kernel *kernel, Error *error)
{
    const uint32_t limit = group_info(kernel, CL_KERNEL_WORK_GROUP_SIZE);
    return limit == 0 || (uint64_t)kernel->group[0] * kernel->group[1] <= limit ||
           error_set(error, "work-groups of %u x %u are too large: %s allows %u work-items",
                     kernel->group[0], kernel->group[1], kernel->device->facts.name, limit);
}

static LaunchShape shape_of(const Kernel *kernel)
{
    const LaunchFacts facts = {
        .is_cpu = kernel->device->is_cpu,
        .is_wide = kernel->choice.nodes == NODES_WIDE,
        .compute_units = kernel->device->facts.compute_units,
        .group_limit = group_info(kernel, CL_KERNEL_WORK_GROUP_SIZE),
        .group_multiple = group_info(kernel, CL_KERNEL_PREFERRED_WORK_GROUP_SIZE_MULTIPLE)};
    LaunchShape shape = launch_shape(&facts);
    for (int i = 0; i < 2; i++)
        shape.group[i] = kernel->group[i] > 0 ? kernel->group[i] : shape.group[i];
    return shape;
}

static cl_int set_arguments(const Kernel *kernel, const KernelRun *run)
{
    const char *kinds = kernel->entry->arguments;
    cl_uint place = 0;
    cl_int status = clSetKernelArg(kernel->handle, place++, sizeof *run->frame, run->frame);
    for (int i = 0; i < FLAT_ARRAYS && status == CL_SUCCESS; i++)
        status = clSetKernelArg(kernel->handle, place++, sizeof *run->scene, &run->scene[i]);
    for (int i = 0; kinds[i] != '\0' && status == CL_SUCCESS; i++)
        status =
            clSetKernelArg(kernel->handle, place++,
                           kinds[i] == 'b' ? sizeof(cl_mem) : sizeof(cl_uint), run->arguments[i]);
    return status;
}

static cl_int enqueue(const Kernel *kernel, const KernelRun *run)
{
    const KernelEntry *entry = kernel->entry;
    const uint32_t *sides = kernel->launch.group;
    const bool is_list = entry->dimensions == 1;
    const bool is_fixed = entry->group > 0 && kernel->device->is_cpu;
    const size_t length = is_fixed ? entry->group : (size_t)sides[0] * sides[1];
    const size_t group[2] = {is_list ? length : sides[0], is_list ? 1 : sides[1]};
    size_t grid[2];
    for (int i = 0; i < 2; i++)
        grid[i] = (run->items[i] + group[i] - 1) / group[i] * group[i];
    return clEnqueueNDRangeKernel(run->queue, kernel->handle, entry->dimensions, NULL, grid, group,
                                  0, NULL, run->done);
}

bool kernel_run(const Kernel *kernel, const KernelRun *run, Error *error)
{
    char attempt[64];
    const cl_int failure = set_arguments(kernel, run);
    const cl_int status = failure != CL_SUCCESS ? failure : enqueue(kernel, run);
    snprintf(attempt, sizeof attempt, "run the kernel %s", kernel->entry->name);
    return cl_succeeded(status, attempt, error);
}

// Runs a new kernel without work, because some drivers finish compiling in the first run. FrameData
// and all numbers are 0, and each buffer holds 16 words with the value NOTHING.
static bool run_empty(const Kernel *kernel, Error *error)
{
    static const FrameData frame;
    static const cl_uint zero, filling = NOTHING;
    const char *kinds = kernel->entry->arguments;
    cl_mem buffer, scene[FLAT_ARRAYS];
    KernelRun run = {kernel->device->queue, &frame, scene, .items = {1, 1}};
    if (!buffer_make(kernel->device, NULL, 64, &buffer, error))
        return false;
    for (int i = 0; i < FLAT_ARRAYS; i++)
        scene[i] = buffer;
    for (int i = 0; kinds[i] != '\0'; i++)
        run.arguments[i] = kinds[i] == 'b' ? (const void *)&buffer : &zero;
    const cl_int status =
        clEnqueueFillBuffer(run.queue, buffer, &filling, sizeof filling, 0, 64, 0, NULL, NULL);
    const bool ok = cl_succeeded(status, "fill a buffer", error) &&
                    kernel_run(kernel, &run, error) &&
                    cl_succeeded(clFinish(run.queue), "finish the first run", error);
    buffer_release(&buffer);
    return ok;
}

static bool start(void *context, Error *error)
{
    Kernel *kernel = context;
    cl_int status;
    kernel->handle = clCreateKernel(kernel->program->handle, kernel->entry->name, &status);
    if (!cl_succeeded(status, "create a kernel", error) || !check_group(kernel, error))
        return false;
    kernel->launch = shape_of(kernel);
    return run_empty(kernel, error);
}

static Program *program_with_key(const KernelSet *set, const char *key)
{
    for (size_t i = 0; i < set->programs.count; i++)
        if (strcmp(set->programs.data[i]->key, key) == 0)
            return set->programs.data[i];
    return NULL;
}

// Creates the kernel in an existing program of the set, and runs it without work.
static bool start_in(Kernel *kernel, const Cache *cache, Error *error)
{
    const int lock = cache_lock(cache);
    const bool ok = start(kernel, error);
    cache_unlock(lock);
    return ok;
}

static bool make_program(KernelSet *set, Kernel *kernel, const ProgramSource *source, Error *error)
{
    const FirstRun first = {start, kernel};
    kernel->program = memory_zeroed(1, sizeof *kernel->program, error);
    if (kernel->program == NULL || !array_push(&set->programs, kernel->program, error)) {
        free(kernel->program);
        return false;
    }
    set->source.arithmetic_is_exact = program_make(kernel->program, source, &first, error);
    if (set->source.arithmetic_is_exact)
        return true;
    set->programs.count--;
    program_free(kernel->program);
    free(kernel->program);
    return false;
}

static bool make(KernelSet *set, Kernel *kernel, const KernelSpec *spec, Error *error)
{
    char key[CACHE_KEY_SIZE];
    const double start_time = clock_seconds();
    const ProgramSource source = source_of(set, spec);
    *kernel = (Kernel){.device = source.device,
                       .entry = spec->entry,
                       .choice = spec->choice,
                       .traits = spec->traits,
                       .group = {spec->group[0], spec->group[1]},
                       .was_compiled = program_is_compiled(&source)};
    program_key(&source, key);
    kernel->program = program_with_key(set, key);
    const bool ok = kernel->program != NULL ? start_in(kernel, source.cache, error)
                                            : make_program(set, kernel, &source, error);
    kernel->seconds = clock_seconds() - start_time;
    return ok;
}

static void free_kernel(Kernel *kernel)
{
    if (kernel != NULL && kernel->handle != NULL)
        clReleaseKernel(kernel->handle);
    free(kernel);
}

const Kernel *kernel_set_get(KernelSet *set, const KernelSpec *spec, Error *error)
{
    for (size_t i = 0; i < set->kernels.count; i++)
        if (is_for(set->kernels.data[i], spec))
            return set->kernels.data[i];
    Kernel *kernel = memory_zeroed(1, sizeof *kernel, error);
    if (kernel != NULL && make(set, kernel, spec, error) &&
        array_push(&set->kernels, kernel, error))
        return kernel;
    free_kernel(kernel);
    return NULL;
}

bool kernel_set_has(const KernelSet *set, const KernelSpec *spec)
{
    const ProgramSource source = source_of(set, spec);
    for (size_t i = 0; i < set->kernels.count; i++)
        if (is_for(set->kernels.data[i], spec))
            return true;
    return program_is_compiled(&source);
}

bool kernel_set_save(KernelSet *set)
{
    bool ok = true;
    for (size_t i = 0; i < set->programs.count; i++)
        ok = program_save(set->programs.data[i]) && ok;
    return ok;
}

void kernel_set_clear(KernelSet *set)
{
    for (size_t i = 0; i < set->kernels.count; i++)
        free_kernel(set->kernels.data[i]);
    for (size_t i = 0; i < set->programs.count; i++) {
        program_free(set->programs.data[i]);
        free(set->programs.data[i]);
    }
    free(set->kernels.data);
    free(set->programs.data);
    *set = (KernelSet){.source = set->source};
}
