// SPDX-License-Identifier: MIT
// FlatScene, Program and camera -> Framebuffer, tile by tile.
#pragma once

#include "image/framebuffer.h"
#include "render/ready_kernel.h"

// Which program draws the scene.  The picture is the same.
typedef enum {
    SPECIALIZE_AUTO, // specialized if already compiled, or if it saves more time than compiling
                     // costs
    SPECIALIZE_ALWAYS,
    SPECIALIZE_NEVER
} Specialization;

typedef struct {
    uint32_t width, height;             // of the crop
    uint32_t left, top;                 // of the crop in the whole picture
    uint32_t whole_width, whole_height; // of the whole picture; 0 without a crop
    uint32_t samples;                   // per pixel and axis
    uint32_t max_level;                 // rays of this level return the background
    uint32_t tile_width, tile_height;
    uint64_t ready_tiles; // the first tiles that exist already and are skipped
    uint32_t part, parts; // draws tile number part of every parts tiles; 0, 0 draws all
    uint32_t group_width, group_height; // of a work-group, in work-items
    bool statistics;
    Specialization specialization;
} RenderSettings;

// Return the size of the whole picture.
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

// The scene's buffers among the kernel's arguments.
#define RENDERER_ARRAYS 7

// This limit keeps sample coordinates exact in float.
#define SAMPLES_MAX 64

typedef struct {
    uint64_t tiles_done, tiles;
    uint64_t tiles_ready;          // of tiles_done, those that existed before
    uint64_t tallies[TALLY_KINDS]; // zeros without statistics
} RenderProgress;

// tile_done is called for every finished tile; returning false stops the picture.
typedef struct {
    bool (*tile_done)(void *context, const RenderProgress *progress);
    void *context;
} RenderObserver;

// Returns whether to continue after a finished tile.  Both pointers of the observer may be NULL.
static inline bool render_observer_continues(const RenderObserver *observer,
                                             const RenderProgress *progress)
{
    return observer == NULL || observer->tile_done == NULL ||
           observer->tile_done(observer->context, progress);
}

typedef struct {
    const Device *device; // borrowed
    RenderSettings settings;
    NodeLayout nodes;
    KernelEntry entry; // of the kernel
    FrameData frame;
    Program program;
    cl_kernel kernel;
    bool is_special;                // whether the program is specialized for the scene
    cl_mem arrays[RENDERER_ARRAYS]; // in the order of the kernel's arguments
    size_t upload_size;             // bytes
    double upload_seconds, build_seconds;
    RenderProgress progress; // of the latest picture
} Renderer;

// Uploads the scene, or shares it with the device, and builds the program.  flat must have the
// choice's node layout and outlive the renderer.
bool renderer_open(Renderer *renderer, const RendererSetup *setup, const FlatScene *flat,
                   const RenderSettings *settings, Error *error);
void renderer_close(Renderer *renderer);

// Sets the size, samples, level and tiles of the following pictures from settings.  Pictures are
// whole, and all other settings remain.
void renderer_resize(Renderer *renderer, const RenderSettings *settings);

// Draws the picture seen by camera into framebuffer, which has the settings' size.  Stores the
// progress in renderer->progress; the observer may have stopped the picture.
bool renderer_draw(Renderer *renderer, const CameraData *camera, const RenderObserver *observer,
                   Framebuffer *framebuffer, Error *error);

// Runs the kernel once over an empty tile, because some drivers finish compiling at the first run.
bool draw_warm_up(Renderer *renderer, Error *error);
