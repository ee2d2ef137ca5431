// SPDX-License-Identifier: MIT
// Splits a list of requests into launches and keeps two launches in the queue, so that the device
// never waits for the host. PoCL compiles a second version of a kernel for grids of 65535
// work-items or more. LAUNCH_ITEMS keeps all grids smaller.
#include "render/sampler.h"

#include "device/buffer.h"

#include <stdlib.h>

#define LAUNCH_ITEMS 4096

typedef struct {
    Renderer *renderer;
    const SampleList *list;
    uint32_t item_requests; // per work-item
    cl_mem requests, results, tallies;
    uint32_t *host_tallies;
    cl_event done[2]; // launch i signals done[i % 2]
} Sampling;

// Host memory, used in place by the device.
typedef struct {
    cl_mem_flags access;
    const void *data;
    size_t size;
} Shared;

static bool is_ladder(const Renderer *renderer)
{
    return renderer->kernel->entry == &ladder_entry;
}

static size_t request_size(const Renderer *renderer)
{
    return is_ladder(renderer) ? sizeof(PixelRequest) : sizeof(SamplePlace);
}

static size_t result_size(const Renderer *renderer)
{
    return is_ladder(renderer) ? sizeof(PixelSums) : sizeof(SampleData);
}

// Returns the number of requests per work-item. The kernels compute the same number.
static uint32_t item_requests(const Renderer *renderer, const SampleList *list)
{
    const PixelRequest *requests = list->requests;
    const uint32_t item_samples =
        renderer->kernel->choice.nodes == NODES_WIDE ? BLOCK_SIDE * BLOCK_SIDE : 1;
    const uint32_t samples = is_ladder(renderer) ? requests[0].samples : 1;
    return samples < item_samples ? item_samples / samples : 1;
}

static uint32_t launch_requests(const Sampling *sampling)
{
    return LAUNCH_ITEMS * sampling->item_requests;
}

static bool share(const Sampling *sampling, const Shared *shared, cl_mem *buffer, Error *error)
{
    cl_int status;
    *buffer = clCreateBuffer(sampling->renderer->kernel->device->context,
                             shared->access | CL_MEM_USE_HOST_PTR, shared->size,
                             (void *)shared->data, &status);
    return cl_succeeded(status, "share the samples with the device", error);
}

static bool open_buffers(Sampling *sampling, Error *error)
{
    const SampleList *list = sampling->list;
    const size_t tallies =
        sampling->renderer->kernel->traits.statistics ? (size_t)list->count * TALLY_KINDS : 16;
    sampling->host_tallies = memory_zeroed(tallies, sizeof *sampling->host_tallies, error);
    if (sampling->host_tallies == NULL)
        return false;
    const Shared requests = {CL_MEM_READ_ONLY, list->requests,
                             list->count * request_size(sampling->renderer)};
    const Shared results = {CL_MEM_READ_WRITE, list->results,
                            list->count * result_size(sampling->renderer)};
    const Shared counts = {CL_MEM_READ_WRITE, sampling->host_tallies,
                           tallies * sizeof *sampling->host_tallies};
    return share(sampling, &requests, &sampling->requests, error) &&
           share(sampling, &results, &sampling->results, error) &&
           share(sampling, &counts, &sampling->tallies, error);
}

// First waits for the queue. After a fault, a running launch may still write to the host memory.
static void close_buffers(Sampling *sampling)
{
    clFinish(sampling->renderer->kernel->device->queue);
    for (int i = 0; i < 2; i++)
        if (sampling->done[i] != NULL)
            clReleaseEvent(sampling->done[i]);
    device_release(&sampling->requests);
    device_release(&sampling->results);
    device_release(&sampling->tallies);
    free(sampling->host_tallies);
}

static bool set_arguments(const Sampling *sampling, const FrameData *frame, Error *error)
{
    const Renderer *renderer = sampling->renderer;
    cl_kernel kernel = renderer->kernel->handle;
    if (!renderer_set_scene(renderer, frame, error))
        return false;
    cl_int status = clSetKernelArg(kernel, FLAT_ARRAYS + 1, sizeof(cl_mem), &sampling->requests);
    status |= clSetKernelArg(kernel, FLAT_ARRAYS + 4, sizeof(cl_mem), &sampling->results);
    status |= clSetKernelArg(kernel, FLAT_ARRAYS + 5, sizeof(cl_mem), &sampling->tallies);
    return cl_succeeded(status, "set the kernel's arguments", error);
}

static const char *sampling_attempt(const Renderer *renderer)
{
    return is_ladder(renderer) ? "run the kernel trace_pixels" : "run the kernel trace_samples";
}

static bool start_launch(Sampling *sampling, uint32_t number, Error *error)
{
    const Renderer *renderer = sampling->renderer;
    const uint32_t most = launch_requests(sampling);
    const cl_uint first = number * most, left = sampling->list->count - first;
    const cl_uint count = left < most ? left : most, end = first + count;
    const size_t group = (size_t)renderer->kernel->group[0] * renderer->kernel->group[1];
    const size_t requests = sampling->item_requests;
    const size_t grid = ((count + requests - 1) / requests + group - 1) / group * group;
    cl_int status = clSetKernelArg(renderer->kernel->handle, FLAT_ARRAYS + 2, sizeof first, &first);
    status |= clSetKernelArg(renderer->kernel->handle, FLAT_ARRAYS + 3, sizeof end, &end);
    if (status == CL_SUCCESS)
        status =
            clEnqueueNDRangeKernel(renderer->kernel->device->queue, renderer->kernel->handle, 1,
                                   NULL, &grid, &group, 0, NULL, &sampling->done[number % 2]);
    if (status == CL_SUCCESS)
        status = clFlush(renderer->kernel->device->queue);
    return cl_succeeded(status, sampling_attempt(renderer), error);
}

static bool finish_launch(Sampling *sampling, uint32_t number, Error *error)
{
    cl_event *done = &sampling->done[number % 2];
    const cl_int status = clWaitForEvents(1, done);
    clReleaseEvent(*done);
    *done = NULL;
    sampling->renderer->progress.tiles_done++;
    return cl_succeeded(status, "trace samples", error);
}

static bool run_launches(Sampling *sampling, const RenderObserver *observer, Error *error)
{
    RenderProgress *progress = &sampling->renderer->progress;
    const uint32_t most = launch_requests(sampling), count = sampling->list->count;
    const uint32_t launches = count / most + (count % most > 0);
    uint32_t started = 0, finished = 0;
    bool wanted = true;
    progress->tiles += launches;
    while (finished < (wanted ? launches : started)) {
        for (; wanted && started < launches && started < finished + 2; started++)
            if (!start_launch(sampling, started, error))
                return false;
        if (!finish_launch(sampling, finished++, error))
            return false;
        wanted = render_observer_continues(observer, progress) && wanted;
    }
    return true;
}

// Makes the device's results visible to the host.
static bool read_back(const Sampling *sampling, cl_mem buffer, size_t size, Error *error)
{
    cl_command_queue queue = sampling->renderer->kernel->device->queue;
    cl_int status;
    void *seen =
        clEnqueueMapBuffer(queue, buffer, CL_TRUE, CL_MAP_READ, 0, size, 0, NULL, NULL, &status);
    if (status == CL_SUCCESS)
        status = clEnqueueUnmapMemObject(queue, buffer, seen, 0, NULL, NULL);
    if (status == CL_SUCCESS)
        status = clFinish(queue);
    return cl_succeeded(status, "read samples back", error);
}

static bool read_tallies(Sampling *sampling, Error *error)
{
    Renderer *renderer = sampling->renderer;
    const size_t tallies = (size_t)sampling->list->count * TALLY_KINDS;
    if (!renderer->kernel->traits.statistics)
        return true;
    if (!read_back(sampling, sampling->tallies, tallies * sizeof *sampling->host_tallies, error))
        return false;
    for (size_t i = 0; i < tallies; i++)
        renderer->progress.tallies[i % TALLY_KINDS] += sampling->host_tallies[i];
    return true;
}

bool sampler_trace(Renderer *renderer, const FrameData *frame, const SampleList *list,
                   const RenderObserver *observer, Error *error)
{
    if (list->count == 0)
        return true;
    Sampling sampling = {renderer, list, .item_requests = item_requests(renderer, list)};
    bool ok = open_buffers(&sampling, error) && set_arguments(&sampling, frame, error) &&
              run_launches(&sampling, observer, error) && read_tallies(&sampling, error) &&
              read_back(&sampling, sampling.results, list->count * result_size(renderer), error);
    close_buffers(&sampling);
    return ok;
}

static bool skip_sample(Renderer *renderer, Error *error)
{
    static const SamplePlace nowhere = {NOTHING, 0};
    SampleData sample;
    const SampleList list = {&nowhere, &sample, 1};
    return sampler_trace(renderer, &(FrameData){0}, &list, NULL, error);
}

static bool skip_pixel(Renderer *renderer, Error *error)
{
    static const PixelRequest outside = {.x = NOTHING, .samples = 1};
    PixelSums sums;
    const SampleList list = {&outside, &sums, 1};
    return sampler_trace(renderer, &(FrameData){0}, &list, NULL, error);
}

static bool sample_first_run(const Kernel *kernel, Error *error)
{
    return renderer_run_first(kernel, skip_sample, error);
}

static bool ladder_first_run(const Kernel *kernel, Error *error)
{
    return renderer_run_first(kernel, skip_pixel, error);
}

// kernels/samples.cl and kernels/ladder.cl, embedded at build time.
extern const char samples_source[], ladder_source[];

const KernelEntry sample_entry = {"trace_samples", samples_source, "-DCLRT_SIGNATURES=1",
                                  sample_first_run};
const KernelEntry ladder_entry = {"trace_pixels", ladder_source, NULL, ladder_first_run};
