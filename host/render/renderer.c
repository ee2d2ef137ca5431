// SPDX-License-Identifier: MIT
// A device that shares the host's memory reads the FlatScene in place.
#include "render/renderer.h"

#include "base/clock.h"
#include "device/buffer.h"

#include <math.h>
#include <string.h>

static FrameData frame_of(const FlatScene *flat)
{
    FrameData frame = {.ambient = flat->ambient,
                       .light_count = flat->light_count,
                       .sphere_count = flat->sphere_count,
                       .sphere_entries = flat->sphere_entries,
                       .triangle_count = flat->triangle_count,
                       .sphere_root = flat->sphere_root,
                       .uses_bvh = flat->triangle_count > 0 && flat->node_count > 0};
    memcpy(frame.background, flat->background, sizeof frame.background);
    memcpy(frame.low, flat->bounds.low, sizeof frame.low);
    memcpy(frame.high, flat->bounds.high, sizeof frame.high);
    return frame;
}

bool scene_buffers_make(SceneBuffers *buffers, const Device *device, const FlatScene *flat,
                        Error *error)
{
    bool ok = true;
    FlatArray arrays[FLAT_ARRAYS];
    const double start = clock_seconds();
    *buffers = (SceneBuffers){.device = device,
                              .frame = frame_of(flat),
                              .traits = traits_of(flat, false),
                              .reflectivity = flat_reflectivity(flat)};
    flat_arrays(flat, arrays);
    for (int i = 0; ok && i < FLAT_ARRAYS; i++) {
        ok = upload_array(device, &arrays[i], &buffers->arrays[i], error);
        buffers->size += arrays[i].bytes;
    }
    buffers->seconds = clock_seconds() - start;
    if (!ok)
        scene_buffers_free(buffers);
    return ok;
}

void scene_buffers_free(SceneBuffers *buffers)
{
    for (int place = 0; place < FLAT_ARRAYS; place++)
        device_release(&buffers->arrays[place]);
    *buffers = (SceneBuffers){0};
}

FrameData renderer_frame(const Renderer *renderer, const CameraData *camera)
{
    const RenderSettings *settings = &renderer->settings;
    FrameData frame = renderer->scene->frame;
    frame.camera = *camera;
    frame.width = render_whole_width(settings);
    frame.height = render_whole_height(settings);
    frame.samples = settings->samples;
    frame.max_level = settings->max_level;
    if (renderer->scene->traits.glass && frame.max_level > GLASS_LEVELS)
        frame.max_level = GLASS_LEVELS;
    return frame;
}

TallyKind renderer_first_tally(const Renderer *renderer)
{
    const SceneTraits *traits = &renderer->kernel->traits;
    return traits->statistics || traits->glass ? TALLY_FIRST(traits->statistics) : TALLY_KINDS;
}

void renderer_add_tallies(Renderer *renderer, const uint32_t *stored, size_t count)
{
    const TallyKind first = renderer_first_tally(renderer);
    for (size_t tally = 0; first < TALLY_KINDS && tally < count; tally++)
        for (uint32_t kind = first; kind < TALLY_KINDS; kind++)
            renderer->progress.tallies[kind] += *stored++;
}

double renderer_truncation(const Renderer *renderer, uint64_t samples)
{
    const uint64_t *tallies = renderer->progress.tallies;
    const double squares = (double)tallies[TALLY_CUT_HIGH] + (double)tallies[TALLY_CUT] * 0x1p-32;
    return sqrt(squares / (double)samples);
}
