// SPDX-License-Identifier: MIT
// Prepares a renderer: buffers, program and kernel. draw.c draws with it.
#include "render/renderer.h"

#include "base/clock.h"
#include "device/buffer.h"

#include <assert.h>
#include <string.h>

// The seconds to compile an uncached program, and the fraction of tracing time that specialization
// saves (0 to 7 % with packets). RAYS_PER_SECOND is one core's rate in a medium scene.
#define COMPILE_SECONDS   1.5
#define SPECIALIZED_SAVES 0.03
#define RAYS_PER_SECOND   3e6
#define RAYS_PER_SAMPLE   2.0

static bool upload_scene(Renderer *renderer, const FlatScene *flat, Error *error)
{
    bool ok = true;
    FlatArray arrays[FLAT_ARRAYS];
    const double start = clock_seconds();
    flat_arrays(flat, arrays);
    for (int i = 0; ok && i < FLAT_ARRAYS; i++) {
        ok = upload_array(renderer->device, &arrays[i], &renderer->arrays[i], error);
        renderer->upload_size += arrays[i].bytes;
    }
    renderer->upload_seconds = clock_seconds() - start;
    return ok;
}

static FrameData frame_of(const FlatScene *flat, const RenderSettings *settings)
{
    FrameData frame = {.ambient = flat->ambient,
                       .width = render_whole_width(settings),
                       .height = render_whole_height(settings),
                       .samples = settings->samples,
                       .max_level = settings->max_level,
                       .light_count = flat->light_count,
                       .sphere_count = flat->sphere_count,
                       .triangle_count = flat->triangle_count,
                       .uses_bvh = flat->node_count > 0};
    memcpy(frame.background, flat->background, sizeof frame.background);
    return frame;
}

static double expected_saving(const Device *device, const RenderSettings *settings)
{
    const double samples =
        (double)settings->width * settings->height * settings->samples * settings->samples;
    const double rate = RAYS_PER_SECOND * device->compute_units;
    return SPECIALIZED_SAVES * samples * RAYS_PER_SAMPLE / rate;
}

static bool specialization_pays(const RendererSetup *setup, const SceneTraits *special,
                                const RenderSettings *settings)
{
    if (settings->specialization != SPECIALIZE_AUTO)
        return settings->specialization == SPECIALIZE_ALWAYS;
    return ready_kernel_is_compiled(setup, special) ||
           (setup->source.kernel_folder == NULL &&
            expected_saving(setup->device, settings) > COMPILE_SECONDS);
}

// Moves setup's ready kernel into the renderer if it fits. Otherwise makes a kernel.
static bool take_kernel(Renderer *renderer, const RendererSetup *setup, const SceneTraits *traits,
                        Error *error)
{
    const RenderSettings *settings = &renderer->settings;
    const uint32_t group[2] = {settings->group_width, settings->group_height};
    ReadyKernel made;
    ReadyKernel *taken = setup->ready;
    if (taken == NULL || !ready_kernel_is(taken, setup, traits, group)) {
        if (!ready_kernel_make(&made, setup, traits, group, error))
            return false;
        taken = &made;
    }
    renderer->program = taken->program;
    renderer->kernel = taken->handle;
    renderer->build_seconds = taken->seconds;
    *taken = (ReadyKernel){0};
    return true;
}

bool renderer_open(Renderer *renderer, const RendererSetup *setup, const FlatScene *flat,
                   const RenderSettings *settings, Error *error)
{
    assert(flat->layout == setup->source.choice.nodes);
    *renderer = (Renderer){.device = setup->device,
                           .settings = *settings,
                           .nodes = setup->source.choice.nodes,
                           .entry = setup->source.entry,
                           .frame = frame_of(flat, settings)};
    const SceneTraits special = traits_of(flat, settings->statistics);
    renderer->is_special = specialization_pays(setup, &special, settings);
    const SceneTraits traits =
        renderer->is_special ? special : traits_general(settings->statistics);
    const bool ok =
        upload_scene(renderer, flat, error) && take_kernel(renderer, setup, &traits, error);
    if (!ok)
        renderer_close(renderer);
    return ok;
}

void renderer_resize(Renderer *renderer, const RenderSettings *settings)
{
    renderer->settings.width = renderer->frame.width = settings->width;
    renderer->settings.height = renderer->frame.height = settings->height;
    renderer->settings.samples = renderer->frame.samples = settings->samples;
    renderer->settings.max_level = renderer->frame.max_level = settings->max_level;
    renderer->settings.tile_width = settings->tile_width;
    renderer->settings.tile_height = settings->tile_height;
}

void renderer_close(Renderer *renderer)
{
    for (int place = 0; place < FLAT_ARRAYS; place++)
        device_release(&renderer->arrays[place]);
    device_release_kernel(&renderer->kernel);
    program_free(&renderer->program);
    *renderer = (Renderer){0};
}
