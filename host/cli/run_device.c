// SPDX-License-Identifier: MIT
// A background thread opens the device while the caller's thread reads the scene. Making the kernel
// on the background thread too would not make runs measurably shorter.
#include "cli/run.h"

#include "base/clock.h"
#include "render/ready_kernel.h"

#include <math.h>
#include <stdlib.h>

static void *open_device(void *context)
{
    Run *run = context;
    AsyncDevice *async = &run->async_device;
    KernelChoice *choice = &async->setup.source.choice;
    const double start = clock_seconds();
    const bool ok = device_open(&async->device, run->options->device, &async->error);
    async->device_seconds = clock_seconds() - start;
    *choice = kernel_choose(&run->options->kernel, &async->device);
    async->is_open = ok && kernel_check_device(choice, &async->device, &async->error);
    return NULL;
}

void run_begin(Run *run)
{
    const Options *options = run->options;
    AsyncDevice *async = &run->async_device;
    const KernelEntry entry = options->contrast > 0           ? KERNEL_SAMPLES
                              : options_are_adaptive(options) ? KERNEL_LADDER
                                                              : KERNEL_TILE;
    async->setup =
        (RendererSetup){.device = &async->device,
                        .cache = &run->cache,
                        .source = {.kernel_folder = getenv("CLRT_KERNEL_DIR"), .entry = entry}};
    async->is_running = device_thread_start(&async->thread, open_device, run);
    if (!async->is_running) // fall back to opening the device on this thread
        open_device(run);
}

// The choice of quick kernels depends on the work of the run, measured in samples of --aa.

// With --error E, a pixel counts as 1 + ERROR_SAMPLES / E samples, because each sample that it
// takes costs about as much as four samples of --aa.
#define ERROR_SAMPLES 0.08

// With --aa-adaptive T, a pixel counts as 1 + CONTRAST_SAMPLES / sqrt(T) samples. CONTRAST_SAMPLES
// was measured as 0.4 to 0.5 in a small scene, and as 2.2 to 2.6 with a mesh.
#define CONTRAST_SAMPLES 1

// Returns a pixel's work, in samples of --aa.
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

// Selects faster-compiling kernels if they save time and the options allow them.
static void choose_quick_kernels(Run *run)
{
    const Options *options = run->options;
    const RenderSettings *settings = &run->settings;
    RendererSetup *setup = &run->async_device.setup;
    const double pictures = options->repeat * (double)frames_count(&options->frames);
    const double pixels = (double)settings->width * settings->height * pictures;
    const QuickKernelRun size = {pixels * samples_per_pixel(options, settings),
                                 pictures * options->time_goal, scene_triangle_count(&run->scene)};
    run->async_device.is_quick =
        leaves_kernels_open(options) && quick_kernel_choose(setup, &size, &setup->source.choice);
}

static void join(AsyncDevice *async)
{
    if (async->is_running)
        pthread_join(async->thread, NULL);
    async->is_running = false;
}

bool run_await_device(Run *run, Error *error)
{
    const Options *options = run->options;
    AsyncDevice *async = &run->async_device;
    join(async);
    if (!async->is_open)
        return error_set(error, "%s", async->error.text);
    choose_quick_kernels(run);
    const uint32_t side = kernel_group_side(&async->setup.source.choice);
    run->settings.group_width = options->group_width > 0 ? options->group_width : side;
    run->settings.group_height = options->group_height > 0 ? options->group_height : side;
    return true;
}

void run_close_device(Run *run)
{
    join(&run->async_device);
    if (CLRT_TIDY_EXIT)
        device_close(&run->async_device.device);
}
