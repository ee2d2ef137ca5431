// SPDX-License-Identifier: MIT
// All scenes use the general kernels, so that a renderer compiles kernels only once.
#include "library/handles.h"

#include "accel/flat.h"
#include "base/processors.h"

#include <pthread.h>
#include <stdlib.h>

static bool open_device(ClrtRenderer *renderer, const char *name, Error *cause)
{
    const KernelRequest none = {0};
    if (!device_open(&renderer->device, name, cause))
        return false;
    const KernelChoice choice = kernel_choose(&none, &renderer->device);
    renderer->setup = (RendererSetup){
        .device = &renderer->device, .cache = &renderer->cache, .source = {.choice = choice}};
    return kernel_check_device(&choice, &renderer->device, cause);
}

static bool make_kernel(ClrtRenderer *renderer, Error *cause)
{
    const SceneTraits traits = traits_general(false);
    const uint32_t side = kernel_group_side(&renderer->setup.source.choice);
    const uint32_t group[2] = {side, side};
    return ready_kernel_make(&renderer->kernel, &renderer->setup, &traits, group, cause);
}

// Opens the device in one thread at a time. PoCL 3.1 crashes if two threads make the first OpenCL
// calls concurrently. These calls may change the environment, which cache_open_for_library reads.
static bool open_renderer(ClrtRenderer *renderer, const char *device, Error *cause)
{
    static pthread_mutex_t opening = PTHREAD_MUTEX_INITIALIZER;
    pthread_mutex_lock(&opening);
    cache_open_for_library(&renderer->cache);
    const bool ok = open_device(renderer, device, cause) && make_kernel(renderer, cause);
    pthread_mutex_unlock(&opening);
    return ok;
}

ClrtRenderer *clrt_renderer_create(const char *device, uint32_t threads, ClrtError *error)
{
    Error cause = {0};
    ClrtRenderer *renderer = memory_zeroed(1, sizeof *renderer, &cause);
    if (renderer != NULL) {
        renderer->threads = threads > 0 ? threads : processors_usable();
        if (open_renderer(renderer, device, &cause))
            return renderer;
    }
    check_fail_for(error, CLRT_DEVICE, &cause);
    clrt_renderer_free(renderer);
    return NULL;
}

static void drop_scene(ClrtRenderer *renderer)
{
    renderer_close(&renderer->renderer);
    flat_free(&renderer->flat);
    renderer->state = 0;
}

void clrt_renderer_free(ClrtRenderer *renderer)
{
    if (renderer == NULL)
        return;
    drop_scene(renderer);
    ready_kernel_free(&renderer->kernel);
    device_close(&renderer->device);
    free(renderer);
}

static bool flatten(ClrtRenderer *renderer, const Scene *scene, Error *cause)
{
    const CompileSource source = {.scene = scene,
                                  .normalization = &renderer->normalization,
                                  .layout = renderer->setup.source.choice.nodes,
                                  .builder = BVH_SAH,
                                  .has_tree = true,
                                  .pool = thread_pool_open(renderer->threads)};
    const bool ok = scene_compile(&renderer->flat, NULL, &source, cause);
    thread_pool_close(source.pool);
    return ok;
}

// The size of 1 x 1 pixels is a placeholder, because each picture sets its size.
static bool open_scene(ClrtRenderer *renderer, Error *cause)
{
    ReadyKernel lent = renderer->kernel;
    RendererSetup setup = renderer->setup;
    const RenderSettings settings = {.width = 1,
                                     .height = 1,
                                     .samples = 1,
                                     .tile_width = 1,
                                     .tile_height = 1,
                                     .group_width = lent.group_width,
                                     .group_height = lent.group_height,
                                     .specialization = SPECIALIZE_NEVER};
    setup.ready = &lent;
    clRetainProgram(lent.program.handle);
    clRetainKernel(lent.handle);
    const bool ok = renderer_open(&renderer->renderer, &setup, &renderer->flat, &settings, cause);
    ready_kernel_free(&lent);
    return ok;
}

bool renderer_handle_take(ClrtRenderer *renderer, const ClrtScene *scene, ClrtError *error)
{
    Error cause = {0};
    if (renderer->state == scene->state)
        return true;
    drop_scene(renderer);
    renderer->normalization = normalization_of(&scene->scene);
    if (!normalization_check(&renderer->normalization, &scene->scene, &cause) ||
        !flatten(renderer, &scene->scene, &cause))
        return check_fail_for(error, CLRT_SCENE, &cause);
    if (!open_scene(renderer, &cause)) {
        drop_scene(renderer);
        return check_fail_for(error, CLRT_DEVICE, &cause);
    }
    renderer->state = scene->state;
    return true;
}
