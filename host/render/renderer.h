// SPDX-License-Identifier: MIT
// A kernel, a scene on a device and a picture's settings -> the kernel's parameters and tallies.
#pragma once

#include "device/kernel.h"
#include "render/scene_buffers.h"
#include "render/tile.h"

typedef struct {
    uint64_t tiles_done, tiles;
    uint64_t tiles_ready; // tiles that existed before the run
    // TALLY_CUT and TALLY_CUT_HIGH are 0 without glass. The other tallies are 0 without statistics.
    uint64_t tallies[TALLY_KINDS];
} RenderProgress;

// tile_done is called after every tile, and by sampler_trace after every launch. If tile_done
// returns false, drawing stops after the tiles or launches in progress.
typedef struct {
    bool (*tile_done)(void *context, const RenderProgress *progress);
    void *context;
} RenderObserver;

// Calls the observer and returns whether to continue. The observer and its function may be NULL.
static inline bool render_observer_continues(const RenderObserver *observer,
                                             const RenderProgress *progress)
{
    return observer == NULL || observer->tile_done == NULL ||
           observer->tile_done(observer->context, progress);
}

// Draws pictures of one size. All members are borrowed, so a renderer needs no cleanup.
typedef struct {
    const Kernel *kernel;
    const SceneBuffers *scene; // in the node layout of the kernel
    RenderSettings settings;
    RenderProgress progress; // of the latest picture
    double launch_samples;   // samples of the sampler's next launch on GPUs; 0 at first
    bool is_special;         // the kernel is specialized for the scene
} Renderer;

// Returns the first kind of RenderProgress::tallies that the kernel stores. The kernel also stores
// the kinds after it. Returns TALLY_KINDS if the kernel stores none.
TallyKind renderer_first_tally(const Renderer *renderer);

// Adds `count` sets of tallies to RenderProgress::tallies. Each set in `stored` has the kinds from
// renderer_first_tally on.
void renderer_add_tallies(Renderer *renderer, const uint32_t *stored, size_t count);

// Returns the kernel's parameters for a picture. Callers set the tile (tile_aim).
FrameData renderer_frame(const Renderer *renderer, const CameraData *camera);

// Returns a bound on the root mean square error of omitting the rays that max_level cuts off. The
// tallies in renderer->progress must be those of `samples` samples. The scene must have glass.
double renderer_truncation(const Renderer *renderer, uint64_t samples);
