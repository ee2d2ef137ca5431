// SPDX-License-Identifier: MIT
// Splits a list of requests into launches and keeps two launches in the queue, so that the device
// never waits for the host. The size of launches depends on the device (device/launch.h). Pictures
// with goals need many short lists, for which PoCL spends more time on launching than on tracing.
// Small and large requests therefore share launches.
#include "render/sampler.h"

#include "base/clock.h"
#include "base/thread_pool.h"
#include "device/buffer.h"

#include <stdlib.h>

// In RenderProgress, this number of work-items counts as one tile.
#define TILE_ITEMS 4096

// Centers are rendered in bands of about this many pixels, to limit the memory for counters.
#define BAND_PIXELS (1u << 18)

// A launch in flight.
typedef struct {
    cl_event done;
    uint32_t items;
    double start;
} SampleLaunch;

typedef struct {
    Renderer *renderer;
    const FrameData *frame;
    const SampleList *list;
    uint32_t items; // work-items of the list
    cl_mem requests, results, tallies;
    uint32_t *host_tallies;
    SampleLaunch launches[2];   // launch i is launches[i % 2]
    uint32_t started, finished; // numbers of work-items
    double last_end;
} Sampling;

// Host memory that the device uses in place.
typedef struct {
    cl_mem_flags access;
    const void *data;
    size_t size;
} Shared;

static bool is_ladder(const Renderer *renderer)
{
    return renderer->kernel->entry == &ladder_entry;
}

// Returns whether the frame has a tile. The centers of its pixels then replace the list's requests.
static bool has_tile(const FrameData *frame)
{
    return frame->tile_width > 0;
}

static size_t requests_size(const Sampling *sampling)
{
    if (has_tile(sampling->frame))
        return sizeof(PixelRequest);
    return sampling->list->count *
           (is_ladder(sampling->renderer) ? sizeof(PixelRequest) : sizeof(SamplePlace));
}

static size_t results_size(const Sampling *sampling)
{
    const FrameData *frame = sampling->frame;
    if (has_tile(frame))
        return (size_t)frame->tile_width * frame->tile_height * sizeof(float[3]);
    return sampling->list->count *
           (is_ladder(sampling->renderer) ? sizeof(PixelSums) : sizeof(SampleData));
}

// Returns the number of pixels along a side of a work-item's block.
static uint32_t block_side(const Renderer *renderer)
{
    return renderer->kernel->choice.nodes == NODES_WIDE ? BLOCK_SIDE : 1;
}

// Returns the number of samples of each request.
static uint32_t request_samples(const Sampling *sampling, bool is_small)
{
    if (!is_ladder(sampling->renderer) || has_tile(sampling->frame))
        return 1;
    return is_small ? SMALL_SAMPLES : LARGE_SAMPLES;
}

// Returns the number of requests per work-item. The kernels compute the same number.
static uint32_t item_requests(const Sampling *sampling, bool is_small)
{
    const uint32_t side = block_side(sampling->renderer), most = side * side;
    const uint32_t samples = request_samples(sampling, is_small);
    return samples < most ? most / samples : 1;
}

// Returns the number of work-items of the small requests.
static uint32_t small_items(const Sampling *sampling)
{
    return range_count(sampling->list->small, item_requests(sampling, true));
}

// Returns the number of work-items of the list.
static uint32_t all_items(const Sampling *sampling)
{
    const SampleList *list = sampling->list;
    return small_items(sampling) +
           range_count(list->count - list->small, item_requests(sampling, false));
}

// Returns the number of requests of the list's first `items` work-items.
static uint32_t requests_of(const Sampling *sampling, uint32_t items)
{
    const SampleList *list = sampling->list;
    const uint32_t early = small_items(sampling);
    if (items == sampling->items)
        return list->count;
    if (items >= early)
        return list->small + (items - early) * item_requests(sampling, false);
    return items * item_requests(sampling, true);
}

// Returns the largest number of samples of a work-item.
static double item_samples(const Sampling *sampling)
{
    const bool is_small = sampling->list->small == sampling->list->count;
    return (double)item_requests(sampling, is_small) * request_samples(sampling, is_small);
}

// Returns the largest number of work-items for the next launch.
static uint32_t launch_items(const Sampling *sampling)
{
    const LaunchShape *shape = &sampling->renderer->kernel->launch;
    const double items = sampling->renderer->launch_samples / item_samples(sampling);
    if (!shape->is_paced || items > shape->items)
        return shape->items;
    return items > 1 ? (uint32_t)items : 1;
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
    const size_t kinds = TALLY_KINDS - renderer_first_tally(sampling->renderer);
    const size_t tallies = kinds > 0 ? list->count * kinds : 16;
    sampling->host_tallies = memory_zeroed(tallies, sizeof *sampling->host_tallies, error);
    if (sampling->host_tallies == NULL)
        return false;
    const Shared requests = {CL_MEM_READ_ONLY, list->requests, requests_size(sampling)};
    const Shared results = {CL_MEM_READ_WRITE, list->results, results_size(sampling)};
    const Shared counts = {CL_MEM_READ_WRITE, sampling->host_tallies,
                           tallies * sizeof *sampling->host_tallies};
    return share(sampling, &requests, &sampling->requests, error) &&
           share(sampling, &results, &sampling->results, error) &&
           share(sampling, &counts, &sampling->tallies, error);
}

// Waits for the queue first, because after a failure, a running launch may still write to host
// memory.
static void close_buffers(Sampling *sampling)
{
    clFinish(sampling->renderer->kernel->device->queue);
    for (int i = 0; i < 2; i++)
        if (sampling->launches[i].done != NULL)
            clReleaseEvent(sampling->launches[i].done);
    buffer_release(&sampling->requests);
    buffer_release(&sampling->results);
    buffer_release(&sampling->tallies);
    free(sampling->host_tallies);
}

static bool start_launch(Sampling *sampling, SampleLaunch *launch, Error *error)
{
    const Renderer *renderer = sampling->renderer;
    const uint32_t most = launch_items(sampling), left = sampling->items - sampling->started;
    const uint32_t items = left < most ? left : most;
    const cl_uint first = sampling->started, end = requests_of(sampling, first + items);
    const cl_uint small = end < sampling->list->small ? end : sampling->list->small;
    const KernelRun run = {.queue = renderer->kernel->device->queue,
                           .frame = sampling->frame,
                           .scene = renderer->scene->arrays,
                           .arguments = {&sampling->requests, &first, &end, &sampling->results,
                                         &sampling->tallies, &small},
                           .items = {items, 1},
                           .done = &launch->done};
    *launch = (SampleLaunch){.items = items, .start = clock_seconds()};
    sampling->started += items;
    return kernel_run(renderer->kernel, &run, error) &&
           cl_succeeded(clFlush(run.queue), "start the kernel", error);
}

// Chooses the size of the next launches. A launch's time counts from its start or from the end of
// the previous launch, whichever is later.
static void pace(Sampling *sampling, const SampleLaunch *launch)
{
    Renderer *renderer = sampling->renderer;
    const double now = clock_seconds();
    const double start = launch->start > sampling->last_end ? launch->start : sampling->last_end;
    renderer->launch_samples = item_samples(sampling) *
                               launch_next_items(&renderer->kernel->launch, launch_items(sampling),
                                                 launch->items, now - start);
    sampling->last_end = now;
}

// Waits for all launches, and makes their output visible to the host.
static bool read_back(const Sampling *sampling, cl_mem buffer, size_t size, Error *error)
{
    cl_command_queue queue = sampling->renderer->kernel->device->queue;
    cl_int status;
    void *seen =
        clEnqueueMapBuffer(queue, buffer, CL_TRUE, CL_MAP_READ, 0, size, 0, NULL, NULL, &status);
    if (status == CL_SUCCESS)
        status = clEnqueueUnmapMemObject(queue, buffer, seen, 0, NULL, NULL);
    return cl_succeeded(status, "read samples back", error);
}

// Waits for the launch. For the last launch, reading the results is the only wait, because on CPUs
// each wait takes as long as tracing about 500 samples.
static bool finish_launch(Sampling *sampling, SampleLaunch *launch, Error *error)
{
    sampling->finished += launch->items;
    const bool ok = sampling->finished == sampling->items
                        ? read_back(sampling, sampling->results, results_size(sampling), error)
                        : cl_succeeded(clWaitForEvents(1, &launch->done), "trace samples", error);
    clReleaseEvent(launch->done);
    launch->done = NULL;
    pace(sampling, launch);
    return ok;
}

static bool run_launches(Sampling *sampling, const RenderObserver *observer, Error *error)
{
    RenderProgress *progress = &sampling->renderer->progress;
    const uint32_t count = sampling->items;
    const uint64_t tiles = progress->tiles_done;
    uint32_t started = 0, finished = 0; // numbers of launches
    bool wanted = true;
    const uint32_t all = range_count(count, TILE_ITEMS);
    progress->tiles += all;
    while (sampling->finished < (wanted ? count : sampling->started)) {
        for (; wanted && sampling->started < count && started < finished + 2; started++)
            if (!start_launch(sampling, &sampling->launches[started % 2], error))
                return false;
        if (!finish_launch(sampling, &sampling->launches[finished++ % 2], error))
            return false;
        progress->tiles_done =
            tiles + (sampling->finished == count ? all : sampling->finished / TILE_ITEMS);
        wanted = render_observer_continues(observer, progress) && wanted;
    }
    return true;
}

static bool read_tallies(Sampling *sampling, Error *error)
{
    const uint32_t count = sampling->list->count;
    const size_t kinds = TALLY_KINDS - renderer_first_tally(sampling->renderer);
    if (kinds == 0)
        return true;
    if (!read_back(sampling, sampling->tallies, count * kinds * sizeof *sampling->host_tallies,
                   error))
        return false;
    renderer_add_tallies(sampling->renderer, sampling->host_tallies, count);
    return true;
}

bool sampler_trace(Renderer *renderer, const FrameData *frame, const SampleList *list,
                   const RenderObserver *observer, Error *error)
{
    if (list->count == 0)
        return true;
    Sampling sampling = {.renderer = renderer, .frame = frame, .list = list};
    sampling.items = all_items(&sampling);
    if (renderer->launch_samples <= 0)
        renderer->launch_samples = launch_first_items(&renderer->kernel->launch, 1);
    bool ok = open_buffers(&sampling, error) && run_launches(&sampling, observer, error) &&
              read_tallies(&sampling, error);
    // Without a stop, finish_launch has read the results back.
    if (ok && sampling.finished < sampling.items)
        ok = read_back(&sampling, sampling.results, results_size(&sampling), error);
    close_buffers(&sampling);
    return ok;
}

bool sampler_is_whole(const Renderer *renderer)
{
    return renderer->progress.tiles_done == renderer->progress.tiles;
}

// Renders the frame's tile.
static bool draw_band(Renderer *renderer, const FrameData *frame, float (*pixels)[3],
                      const RenderObserver *observer, Error *error)
{
    const PixelRequest none = {0};
    const uint32_t side = block_side(renderer);
    const uint32_t blocks =
        range_count(frame->tile_width, side) * range_count(frame->tile_height, side);
    const SampleList list = {&none, pixels, blocks * side * side, 0};
    return sampler_trace(renderer, frame, &list, observer, error);
}

bool sampler_draw_centers(Renderer *renderer, const FrameData *frame, float (*pixels)[3],
                          const RenderObserver *observer, Error *error)
{
    const uint32_t rows = BAND_PIXELS / frame->width, most = rows - rows % BLOCK_SIDE + BLOCK_SIDE;
    FrameData band = *frame;
    band.tile_width = frame->width;
    for (; band.tile_y < frame->height && sampler_is_whole(renderer); band.tile_y += most) {
        const uint32_t left = frame->height - band.tile_y;
        float(*first)[3] = pixels + (size_t)band.tile_y * frame->width;
        band.tile_height = left < most ? left : most;
        if (!draw_band(renderer, &band, first, observer, error))
            return false;
    }
    return true;
}

extern const char samples_source[]; // kernels/samples.cl, embedded at build time

const KernelEntry sample_entry = {"trace_samples", samples_source, "-DCLRT_PLACES=1", "bnnbbn",
                                  .dimensions = 1};
const KernelEntry ladder_entry = {"trace_samples", samples_source, NULL, "bnnbbn", .dimensions = 1};
