// SPDX-License-Identifier: MIT
// FlatScene, Program and camera -> Framebuffer, tile by tile.
#pragma once

#include "image/framebuffer.h"
#include "render/ready_kernel.h"

// Which program draws the scene; the picture is the same.
typedef enum {
    SPECIALIZE_AUTO, // specialized where it is compiled already or saves more than compiling costs
    SPECIALIZE_ALWAYS,
    SPECIALIZE_NEVER
} Specialization;

typedef struct {
    uint32_t width, height;             // of what is drawn
    uint32_t left, top;                 // where that lies in the whole picture,
    uint32_t whole_width, whole_height; // whose size this is; 0 where all of it is drawn
    uint32_t samples;                   // per pixel and axis
    uint32_t max_level;                 // rays of this level return the background
    uint32_t tile_width, tile_height;
    uint64_t ready_tiles; // that many of the first are there already and are not drawn
    uint32_t part, parts; // of every so many tiles the one of that place is drawn; 0, 0: all are
    uint32_t group_width, group_height; // of work-groups, in work-items
    bool statistics;
    Specialization specialization;
} RenderSettings;

// The size of the whole picture.
static inline uint32_t render_whole_width(const RenderSettings *settings)
{
    return settings->whole_width > 0 ? settings->whole_width : settings->width;
}

static inline uint32_t render_whole_height(const RenderSettings *settings)
{
    return settings->whole_height > 0 ? settings->whole_height : settings->height;
}

static inline bool render_is_part(const RenderSettings *settings)
{
    return settings->width < render_whole_width(settings) ||
           settings->height < render_whole_height(settings);
}

// Buffers of the scene, among the kernel's arguments.
#define RENDERER_ARRAYS 7

// The limit keeps sample coordinates exact in float.
#define SAMPLES_MAX 64

typedef struct {
    uint64_t tiles_done, tiles;
    uint64_t tiles_ready;          // of those done, that were there before
    uint64_t tallies[TALLY_KINDS]; // zeros unless statistics were asked for
} RenderProgress;

// Told of every finished tile; returning false stops the picture where it is.
typedef struct {
    bool (*tile_done)(void *context, const RenderProgress *progress);
    void *context;
} RenderObserver;

typedef struct {
    const Device *device; // borrowed
    RenderSettings settings;
    NodeLayout nodes;
    KernelEntry entry; // of the kernel
    FrameData frame;
    Program program;
    cl_kernel kernel;
    bool is_special;                // the program is specialized for the scene
    cl_mem arrays[RENDERER_ARRAYS]; // in the order of the kernel's arguments
    size_t upload_size;             // bytes
    double upload_seconds, build_seconds;
    RenderProgress progress; // of the latest picture
} Renderer;

// Uploads the scene, or lets the device read it where it is, and builds the program.  The scene is
// flattened for the nodes of the choice and outlives the renderer.
bool renderer_open(Renderer *renderer, const RendererSetup *setup, const FlatScene *flat,
                   const RenderSettings *settings, Error *error);
void renderer_close(Renderer *renderer);

// Takes another size of pictures, which are drawn whole, other samples, levels and tiles from
// settings; the rest stays.
void renderer_resize(Renderer *renderer, const RenderSettings *settings);

// Draws the picture seen by camera into framebuffer, which has the settings' size, and leaves how
// far it came in renderer->progress: the observer may have stopped it.
bool renderer_draw(Renderer *renderer, const CameraData *camera, const RenderObserver *observer,
                   Framebuffer *framebuffer, Error *error);
