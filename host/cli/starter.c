// SPDX-License-Identifier: MIT
// The kernel made ahead is the general one: which special one a scene wants, nobody knows before
// it is read.
#include "cli/starter.h"

#include "base/clock.h"
#include "render/quick_kernel.h"

// Compilers recurse deeply, and a thread's stack may be smaller than the process's.
#define STACK_SIZE ((size_t)16 << 20)

static void take_choice(Starter *starter, KernelChoice choice)
{
    const Options *options = starter->options;
    const uint32_t side = kernel_group_side(&choice);
    starter->setup.source.choice = choice;
    starter->group[0] = options->group_width > 0 ? options->group_width : side;
    starter->group[1] = options->group_height > 0 ? options->group_height : side;
}

static bool open_device(Starter *starter)
{
    const Options *options = starter->options;
    const double start = clock_seconds();
    bool ok = device_open(&starter->device, options->device, &starter->error);
    starter->device_seconds = clock_seconds() - start;
    const KernelChoice choice = kernel_choose(&options->kernel, &starter->device);
    take_choice(starter, choice);
    ok = ok && kernel_check_device(&choice, &starter->device, &starter->error);
    return ok;
}

// Returns whether the kernel is to be made here: one that is compiled unless it is known not to be
// wanted, and another when it is known to be.
static bool tell_device(Starter *starter, bool is_open, bool is_compiled)
{
    pthread_mutex_lock(&starter->mutex);
    starter->is_done = true;
    starter->is_open = is_open;
    pthread_cond_broadcast(&starter->changed);
    while (is_open && !is_compiled && !starter->is_decided)
        pthread_cond_wait(&starter->changed, &starter->mutex);
    const bool wanted = is_open && (starter->is_wanted || !starter->is_decided);
    pthread_mutex_unlock(&starter->mutex);
    return wanted;
}

static void *start(void *context)
{
    Starter *starter = context;
    const Options *options = starter->options;
    Error unused = {0};
    const SceneTraits traits = traits_general(options->statistics);
    const bool is_open = open_device(starter);
    const bool is_compiled = is_open && ready_kernel_is_compiled(&starter->setup, &traits);
    if (tell_device(starter, is_open, is_compiled) && options->specialization != SPECIALIZE_ALWAYS)
        ready_kernel_make(&starter->ready, &starter->setup, &traits, starter->group, &unused);
    return NULL;
}

void starter_begin(Starter *starter, const Options *options, RendererSetup setup)
{
    pthread_attr_t attributes;
    *starter = (Starter){.setup = setup, .options = options};
    starter->setup.device = &starter->device;
    starter->setup.ready = &starter->ready;
    pthread_mutex_init(&starter->mutex, NULL);
    pthread_cond_init(&starter->changed, NULL);
    starter->exists = true;
    pthread_attr_init(&attributes);
    pthread_attr_setstacksize(&attributes, STACK_SIZE);
    starter->is_running = pthread_create(&starter->thread, &attributes, start, starter) == 0;
    pthread_attr_destroy(&attributes);
    if (!starter->is_running) // then one after the other
        tell_device(starter, open_device(starter), true);
}

void starter_decide(Starter *starter, bool wanted)
{
    pthread_mutex_lock(&starter->mutex);
    if (!starter->is_decided)
        starter->is_wanted = wanted;
    starter->is_decided = true;
    pthread_cond_broadcast(&starter->changed);
    pthread_mutex_unlock(&starter->mutex);
}

// Whoever asks for certain kernels gets them, and whoever counts gets the same counts every time.
static bool leaves_kernels_open(const Options *options)
{
    const KernelRequest *request = &options->kernel;
    return options->action == ACTION_RENDER && request->family == 0 && request->nodes == 0 &&
           request->lanes == 0 && request->precision == PRECISION_FP32 && options->uses_bvh &&
           !options->statistics && options->specialization != SPECIALIZE_ALWAYS;
}

void starter_choose(Starter *starter, const RenderSettings *settings, uint64_t triangles)
{
    KernelChoice choice;
    const double pixels = (double)settings->width * settings->height * starter->options->repeat *
                          frames_count(&starter->options->frames);
    const QuickKernelRun run = {pixels * settings->samples * settings->samples, triangles};
    starter->is_quick = leaves_kernels_open(starter->options) &&
                        quick_kernel_choose(&starter->setup, &run, &choice);
    if (starter->is_quick)
        take_choice(starter, choice);
}

bool starter_wait_device(Starter *starter, Error *error)
{
    pthread_mutex_lock(&starter->mutex);
    while (!starter->is_done)
        pthread_cond_wait(&starter->changed, &starter->mutex);
    pthread_mutex_unlock(&starter->mutex);
    return starter->is_open || error_set(error, "%s", starter->error.text);
}

void starter_wait_kernel(Starter *starter)
{
    if (!starter->is_running)
        return;
    starter_decide(starter, false);
    pthread_join(starter->thread, NULL);
    starter->is_running = false;
}

void starter_free(Starter *starter)
{
    if (!starter->exists)
        return;
    starter_wait_kernel(starter);
    ready_kernel_free(&starter->ready);
    device_close(&starter->device);
    pthread_cond_destroy(&starter->changed);
    pthread_mutex_destroy(&starter->mutex);
    *starter = (Starter){0};
}
