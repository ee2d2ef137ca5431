// SPDX-License-Identifier: MIT
// A device that shares the host's memory reads the FlatScene in place.
#include "render/scene_buffers.h"

#include "base/clock.h"
#include "device/buffer.h"

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
                              .reflectivity = traits_reflectivity(flat)};
    flat_arrays(flat, arrays);
    for (int i = 0; ok && i < FLAT_ARRAYS; i++) {
        ok = buffer_upload(device, &arrays[i], &buffers->arrays[i], error);
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
        buffer_release(&buffers->arrays[place]);
    *buffers = (SceneBuffers){0};
}
