// SPDX-License-Identifier: MIT
// A background thread opens the device and makes the general kernel. The specialized kernel depends
// on the scene, which another thread is still reading.
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
    bool ok = device_open(&async->device, options->device, &async->error);
    async->device_seconds = clock_seconds() - start;
    const KernelChoice choice = kernel_choose(&options->kernel, &async->device);
    take_choice(async, choice);
    ok = ok && kernel_check_device(&choice, &async->device, &async->error);
    return ok;
}

// Publishes the device and returns whether this thread should make the kernel. The thread loads a
// cached kernel unless the caller has declined it. It compiles an uncached kernel only on request,
// so it waits for the decision.
static bool publish_device(AsyncDevice *async, bool is_open, bool is_compiled)
{
    pthread_mutex_lock(&async->mutex);
    async->is_done = true;
    async->is_open = is_open;
    pthread_cond_broadcast(&async->changed);
    while (is_open && !is_compiled && !async->is_decided)
        pthread_cond_wait(&async->changed, &async->mutex);
    const bool wanted = is_open && (async->is_wanted || !async->is_decided);
    pthread_mutex_unlock(&async->mutex);
    return wanted;
}

static void *start(void *context)
{
    AsyncDevice *async = context;
    const Options *options = async->options;
    Error unused = {0};
    const SceneTraits traits = traits_general(options->statistics);
    const bool is_open = open_device(async);
    const bool is_compiled = is_open && ready_kernel_is_compiled(&async->setup, &traits);
    if (publish_device(async, is_open, is_compiled) && options->specialization != SPECIALIZE_ALWAYS)
        ready_kernel_make(&async->ready, &async->setup, &traits, async->group, &unused);
    return NULL;
}

void async_device_begin(AsyncDevice *async, const Options *options, RendererSetup setup)
{
    *async = (AsyncDevice){.setup = setup, .options = options};
    async->setup.device = &async->device;
    async->setup.ready = &async->ready;
    pthread_mutex_init(&async->mutex, NULL);
    pthread_cond_init(&async->changed, NULL);
    async->exists = true;
    async->is_running = device_thread_start(&async->thread, start, async);
    if (!async->is_running) // fall back to opening the device on this thread
        publish_device(async, open_device(async), true);
}

void async_device_decide(AsyncDevice *async, bool wanted)
{
    pthread_mutex_lock(&async->mutex);
    if (!async->is_decided)
        async->is_wanted = wanted;
    async->is_decided = true;
    pthread_cond_broadcast(&async->changed);
    pthread_mutex_unlock(&async->mutex);
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

bool async_device_wait_device(AsyncDevice *async, Error *error)
{
    pthread_mutex_lock(&async->mutex);
    while (!async->is_done)
        pthread_cond_wait(&async->changed, &async->mutex);
    pthread_mutex_unlock(&async->mutex);
    return async->is_open || error_set(error, "%s", async->error.text);
}

void async_device_wait_kernel(AsyncDevice *async)
{
    if (!async->is_running)
        return;
    async_device_decide(async, false);
    pthread_join(async->thread, NULL);
    async->is_running = false;
}

void async_device_free(AsyncDevice *async)
{
    if (!async->exists)
        return;
    async_device_wait_kernel(async);
    ready_kernel_free(&async->ready);
    device_close(&async->device);
    pthread_cond_destroy(&async->changed);
    pthread_mutex_destroy(&async->mutex);
    *async = (AsyncDevice){0};
}
