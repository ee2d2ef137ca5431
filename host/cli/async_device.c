// SPDX-License-Identifier: MIT
// A background thread opens the device, and the caller's thread reads the scene. Making the kernel
// there, too, would not make runs measurably shorter.
#include "cli/run.h"

#include "base/clock.h"
#include "render/ready_kernel.h"

#include <math.h>

static void take_choice(AsyncDevice *async, KernelChoice choice)
{
    const Options *options = async->options;
    const uint32_t side = kernel_group_side(&choice);
    async->setup.source.choice = choice;
    async->group[0] = options->group_width > 0 ? options->group_width : side;
    async->group[1] = options->group_height > 0 ? options->group_height : side;
}

static bool open_device(AsyncDevice *async)
{
    const Options *options = async->options;
    const double start = clock_seconds();
    const bool ok = device_open(&async->device, options->device, &async->error);
    async->device_seconds = clock_seconds() - start;
    const KernelChoice choice = kernel_choose(&options->kernel, &async->device);
    take_choice(async, choice);
    return ok && kernel_check_device(&choice, &async->device, &async->error);
}

static void *start(void *context)
{
    AsyncDevice *async = context;
    async->is_open = open_device(async);
    return NULL;
}

void async_device_begin(AsyncDevice *async, const Options *options, RendererSetup setup)
{
    *async = (AsyncDevice){.setup = setup, .options = options};
    async->setup.device = &async->device;
    async->is_running = device_thread_start(&async->thread, start, async);
    if (!async->is_running) // fall back to opening the device on this thread
        start(async);
}

// A pixel's samples for an error goal, times the goal. Each counts for about four samples of --aa.
#define ERROR_SAMPLES 0.08

// As many samples of --aa lose as much time by single rays as a pixel with a contrast, times the
// square root of the contrast: 0.4 to 0.5 in a small scene, 2.2 to 2.6 with a mesh.
#define CONTRAST_SAMPLES 1

// Returns the number of samples of --aa that lose as much time by single rays as a pixel.
static double samples_per_pixel(const Options *options, const RenderSettings *settings)
{
    if (options->error_goal > 0)
        return 1 + ERROR_SAMPLES / options->error_goal;
    if (options->contrast > 0)
        return 1 + CONTRAST_SAMPLES / sqrt(options->contrast);
    return (double)settings->samples * settings->samples;
}

// Returns whether clrt may choose the kernels. Explicit requests take precedence, and statistics
// must not depend on the cached kernels.
static bool leaves_kernels_open(const Options *options)
{
    const KernelRequest *request = &options->kernel;
    return options->action == ACTION_RENDER && request->family == 0 && request->nodes == 0 &&
           request->lanes == 0 && request->precision == PRECISION_FP32 && !options->no_bvh &&
           !options->statistics && options->specialization != SPECIALIZE_ALWAYS;
}

void async_device_choose(AsyncDevice *async, const RenderSettings *settings, uint64_t triangles)
{
    KernelChoice choice;
    const Options *options = async->options;
    const double pictures = options->repeat * (double)frames_count(&options->frames);
    const double pixels = (double)settings->width * settings->height * pictures;
    const QuickKernelRun run = {pixels * samples_per_pixel(options, settings),
                                pictures * options->time_goal, triangles};
    async->is_quick =
        leaves_kernels_open(options) && quick_kernel_choose(&async->setup, &run, &choice);
    if (async->is_quick)
        take_choice(async, choice);
}

static void join(AsyncDevice *async)
{
    if (async->is_running)
        pthread_join(async->thread, NULL);
    async->is_running = false;
}

bool async_device_wait(AsyncDevice *async, Error *error)
{
    join(async);
    return async->is_open || error_set(error, "%s", async->error.text);
}

void async_device_free(AsyncDevice *async)
{
    join(async);
    if (CLRT_TIDY_EXIT)
        device_close(&async->device);
}
