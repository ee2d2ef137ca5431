// SPDX-License-Identifier: MIT
// Makes programs from the cache or, with a first run, from source.
#include "render/ready_kernel.h"

#include "base/clock.h"
#include "device/buffer.h"
#include "render/renderer.h"

#include <string.h>

static bool build_from_source(Program *program, const RendererSetup *setup,
                              const SceneTraits *traits, const FirstRun *first, Error *error)
{
    const Cache *cache = setup->cache;
    if (cache->announce != NULL)
        cache->announce(true);
    const bool ok = program_build(program, setup->device, &setup->source, traits, error) &&
                    first->run(first->context, error);
    if (cache->announce != NULL)
        cache->announce(false);
    program_key(setup->device, &setup->source, traits, cache, program->key);
    // The key of kernels under development would have to contain every edit.
    program->unsaved = ok && setup->source.kernel_folder == NULL ? cache : NULL;
    return ok;
}

bool program_make(Program *program, const RendererSetup *setup, const SceneTraits *traits,
                  const FirstRun *first, Error *error)
{
    const int lock = cache_lock(setup->cache);
    const bool is_loaded =
        setup->source.kernel_folder == NULL &&
        program_load(program, setup->device, &setup->source, traits, setup->cache);
    const bool ok = is_loaded ? first->run(first->context, error)
                              : build_from_source(program, setup, traits, first, error);
    cache_unlock(lock);
    return ok;
}

typedef struct {
    ReadyKernel *ready;
    const RendererSetup *setup;
} Making;

// Creates the kernel and runs one of its work-groups without pixels, with a dummy renderer and
// dummy buffers.
static bool run_once(void *context, Error *error)
{
    const Making *making = context;
    const RendererSetup *setup = making->setup;
    ReadyKernel *ready = making->ready;
    cl_int status;
    cl_mem nothing;
    ready->handle =
        clCreateKernel(ready->program.handle, program_entry_name(setup->source.entry), &status);
    if (!cl_succeeded(status, "create the kernel", error) ||
        !device_buffer(setup->device, 64, &nothing, error))
        return false;
    Renderer renderer = {.device = setup->device,
                         .settings = {.width = 1,
                                      .height = 1,
                                      .samples = 1,
                                      .tile_width = 1,
                                      .tile_height = 1,
                                      .group_width = ready->group_width,
                                      .group_height = ready->group_height},
                         .nodes = setup->source.choice.nodes,
                         .entry = setup->source.entry,
                         .kernel = ready->handle};
    for (int place = 0; place < FLAT_ARRAYS; place++)
        renderer.arrays[place] = nothing;
    const bool ok = renderer.entry == KERNEL_TILE ? draw_warm_up(&renderer, error)
                                                  : sampler_warm_up(&renderer, error);
    device_release(&nothing);
    return ok;
}

bool ready_kernel_is_compiled(const RendererSetup *setup, const SceneTraits *traits)
{
    char key[CACHE_KEY_SIZE];
    program_key(setup->device, &setup->source, traits, setup->cache, key);
    return setup->source.kernel_folder == NULL && cache_has(setup->cache, key);
}

bool ready_kernel_make(ReadyKernel *ready, const RendererSetup *setup, const SceneTraits *traits,
                       const uint32_t group[2], Error *error)
{
    Making making = {ready, setup};
    const FirstRun first = {run_once, &making};
    const double start = clock_seconds();
    *ready = (ReadyKernel){.group_width = group[0], .group_height = group[1]};
    ready->was_compiled = ready_kernel_is_compiled(setup, traits);
    const bool ok = program_make(&ready->program, setup, traits, &first, error);
    ready->seconds = clock_seconds() - start;
    if (!ok)
        ready_kernel_free(ready);
    return ok;
}

void ready_kernel_free(ReadyKernel *ready)
{
    device_release_kernel(&ready->handle);
    program_free(&ready->program);
    *ready = (ReadyKernel){0};
}

bool ready_kernel_is(const ReadyKernel *ready, const RendererSetup *setup,
                     const SceneTraits *traits, const uint32_t group[2])
{
    char key[CACHE_KEY_SIZE];
    program_key(setup->device, &setup->source, traits, setup->cache, key);
    return ready->handle != NULL && strcmp(ready->program.key, key) == 0 &&
           ready->group_width == group[0] && ready->group_height == group[1];
}

// Measured compile times in seconds, and the core seconds that packets save per sample in scenes
// with fewer than FEW_TRIANGLES triangles.
#define PACKET_COMPILE_SECONDS 1.25
#define QUICK_COMPILE_SECONDS  0.8
#define FEW_TRIANGLES          20000
#define SAVED_PER_SAMPLE       0.3e-6

// The fraction of a time limit that the quick kernels lose, because they take at most half as many
// samples in that time.
#define LOST_OF_LIMIT 0.5

static RendererSetup setup_with(const RendererSetup *setup, KernelChoice choice)
{
    RendererSetup other = *setup;
    other.source.choice = choice;
    return other;
}

static double seconds_lost(const RendererSetup *setup, const QuickKernelRun *run)
{
    return run->samples * SAVED_PER_SAMPLE / setup->device->compute_units +
           LOST_OF_LIMIT * run->seconds;
}

// Chooses the quick kernels if they save more compile time than the run then loses.
bool quick_kernel_choose(const RendererSetup *setup, const QuickKernelRun *run,
                         KernelChoice *choice)
{
    const SceneTraits traits = traits_general(false);
    const RendererSetup quick =
        setup_with(setup, (KernelChoice){FAMILY_RAY, NODES_PAIR, 0, PRECISION_FP32});
    // Kernels under development never count as compiled.
    if (setup->source.choice.family != FAMILY_PACKET || setup->source.kernel_folder != NULL ||
        run->triangles >= FEW_TRIANGLES || ready_kernel_is_compiled(setup, &traits))
        return false;
    const double saved = ready_kernel_is_compiled(&quick, &traits) ? 0 : QUICK_COMPILE_SECONDS;
    if (seconds_lost(setup, run) > PACKET_COMPILE_SECONDS - saved)
        return false;
    *choice = quick.source.choice;
    return true;
}
