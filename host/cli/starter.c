// SPDX-License-Identifier: MIT
// The kernel made ahead is the general one: which special one a scene wants, nobody knows before
// it is read.
#include "cli/starter.h"

#include "base/clock.h"

// Work-items along the sides of a work-group.
#define RAY_GROUP    8
#define PACKET_GROUP 2

// Compilers recurse deeply, and a thread's stack may be smaller than the process's.
#define STACK_SIZE ((size_t)16 << 20)

static bool open_device(Starter *starter)
{
    const Options *options = starter->options;
    const double start = clock_seconds();
    const bool ok = device_open(&starter->device, options->device, &starter->error);
    starter->device_seconds = clock_seconds() - start;
    KernelChoice *choice = &starter->setup.source.choice;
    *choice = kernel_choose(&options->kernel, starter->device.is_cpu);
    const uint32_t side = choice->nodes == NODES_WIDE ? PACKET_GROUP : RAY_GROUP;
    starter->group[0] = options->group_width > 0 ? options->group_width : side;
    starter->group[1] = options->group_height > 0 ? options->group_height : side;
    return ok;
}

// Returns whether a kernel is wanted after all.
static bool tell_device(Starter *starter, bool is_open)
{
    pthread_mutex_lock(&starter->mutex);
    starter->is_done = true;
    starter->is_open = is_open;
    const bool wanted = is_open && !starter->skips_kernel;
    pthread_cond_signal(&starter->changed);
    pthread_mutex_unlock(&starter->mutex);
    return wanted;
}

static void *start(void *context)
{
    Starter *starter = context;
    const Options *options = starter->options;
    Error unused = {0};
    const SceneTraits traits = traits_general(options->statistics);
    if (tell_device(starter, open_device(starter)) && options->specialization != SPECIALIZE_ALWAYS)
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
        tell_device(starter, open_device(starter));
}

void starter_skip_kernel(Starter *starter)
{
    pthread_mutex_lock(&starter->mutex);
    starter->skips_kernel = true;
    pthread_mutex_unlock(&starter->mutex);
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
    if (starter->is_running)
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
