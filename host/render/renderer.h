// SPDX-License-Identifier: MIT
// FlatScene, Program and camera -> Framebuffer, tile by tile.
#pragma once

#include "image/framebuffer.h"
#include "render/ready_kernel.h"

// The program that draws: general, or specialized for this scene. Both draw the same picture.
typedef enum {
    SPECIALIZE_AUTO, // specialized if compiled already, or if it saves more than compiling takes
    SPECIALIZE_ALWAYS,
    SPECIALIZE_NEVER
} Specialization;

typedef struct {
    uint32_t width, height;             // size of the crop
    uint32_t left, top;                 // position of the crop in the whole picture
    uint32_t whole_width, whole_height; // size of the whole picture; 0 without a crop
    uint32_t samples;                   // along each side of a pixel
    uint32_t max_level; // rays of this level return the background; camera rays have level 0
    uint32_t tile_width, tile_height;
    uint64_t ready_tiles; // number of leading tiles that exist already and are skipped
    uint32_t part, parts; // draws one of `parts` parts (see Tile); 0, 0 draws all tiles
    uint32_t group_width, group_height; // work-group size in work-items
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

// The largest RenderSettings::samples. This limit keeps sample coordinates exact in float.
#define SAMPLES_MAX 64

typedef struct {
    uint64_t tiles_done, tiles;
    uint64_t tiles_ready;          // tiles that existed before the run
    uint64_t tallies[TALLY_KINDS]; // zeros without statistics
} RenderProgress;

// tile_done is called after every finished tile, and returns false to stop the picture.
typedef struct {
    bool (*tile_done)(void *context, const RenderProgress *progress);
    void *context;
} RenderObserver;

// Returns whether to continue after a finished tile. observer and its function may be NULL.
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
    KernelEntry entry; // the entry function of kernel
    FrameData frame;
    Program program;
    cl_kernel kernel;
    bool is_special;            // the program is specialized for the scene
    cl_mem arrays[FLAT_ARRAYS]; // in the order of the kernel's arguments
    size_t upload_size;         // bytes
    double upload_seconds, build_seconds;
    RenderProgress progress; // of the latest picture
} Renderer;

// Uploads the scene, or shares its memory with the device, and makes the kernel. flat must have
// setup's node layout and outlive the renderer.
bool renderer_open(Renderer *renderer, const RendererSetup *setup, const FlatScene *flat,
                   const RenderSettings *settings, Error *error);
void renderer_close(Renderer *renderer);

// Sets the size, samples, max_level and tile size of the next pictures, which must be whole.
void renderer_resize(Renderer *renderer, const RenderSettings *settings);

// Draws the camera's picture into framebuffer. Fails unless it has the size of tile_frame_size. If
// the observer stops the picture, the call returns true with fewer tiles_done than tiles.
bool renderer_draw(Renderer *renderer, const CameraData *camera, const RenderObserver *observer,
                   Framebuffer *framebuffer, Error *error);

// Runs the renderer's kernel once over an empty tile.
bool draw_warm_up(Renderer *renderer, Error *error);

// Sets the first arguments of a kernel: the frame and the scene's arrays.
bool renderer_set_scene(const Renderer *renderer, cl_kernel kernel, const FrameData *frame,
                        Error *error);

// Splits a picture into tiles, row by row from its upper left corner, and selects the tiles to
// draw. A part draws every parts-th tile of each row, from a column that varies between rows.
typedef struct {
    uint32_t x, y, width, height; // in pixels of the crop
    uint32_t left, top;           // position in the framebuffer
} Tile;

// Stores the size of the framebuffer in which the tiles are drawn. A part's framebuffer contains
// only the part's tiles, below each other.
void tile_frame_size(const RenderSettings *settings, uint32_t *width, uint32_t *height);

// Return the number of tiles to draw, and the position and size of one of them.
uint64_t tile_count(const RenderSettings *settings);
Tile tile_at(const RenderSettings *settings, uint64_t number);

// Returns the size of the largest tile, with x and y 0.
Tile tile_largest(const RenderSettings *settings);

// Sets the tile that the frame draws.
void tile_aim(FrameData *frame, const RenderSettings *settings, const Tile *tile);

// Stores in grid the number of work-items along both sides of a tile, rounded up to whole
// work-groups. All tiles have the same grid, including clipped tiles.
void tile_grid(const RenderSettings *settings, NodeLayout nodes, size_t grid[2]);

// A kernel that computes values for each pixel of a tile. Its arguments are the frame, the scene's
// arrays and the outputs.
typedef struct {
    cl_kernel kernel;
    FrameData frame; // without a tile
    int outputs;     // 1 or 2
    size_t sizes[2]; // bytes per pixel of each output; 0 if the kernel does not write the second
    uint64_t first;  // the number of the first tile to draw
    // Receives a tile's outputs, row by row. The tiles come in the order of their numbers.
    void (*take)(void *context, const Tile *tile, void *const values[2]);
    void *context;
} TilePass;

// Runs the pass until the observer returns false, and adds each finished tile to progress.
bool tile_pass_run(const TilePass *pass, const Renderer *renderer, const RenderObserver *observer,
                   RenderProgress *progress, Error *error);

// Runs the pass once over an empty tile, because some drivers finish compiling at the first run.
bool tile_pass_warm_up(const TilePass *pass, const Renderer *renderer, Error *error);

// Sample positions in a picture -> colors and signatures, or sums of colors (KERNEL_LADDER).
// Signatures differ if rays hit different surfaces, or if different lights reach the hit points.

// A position in sub-pixels of the whole picture. The kernel skips samples whose x is NOTHING.
typedef struct {
    uint32_t x, y;
} SamplePlace;

// Requests and their results in the kernel's layout. KERNEL_SAMPLES uses SamplePlace and
// SampleData; KERNEL_LADDER uses PixelRequest and PixelSums.
typedef struct {
    const void *requests;
    void *results; // output; undefined for skipped requests
    uint32_t count;
} SampleList;

// Traces the requests in list. The renderer's kernel must be KERNEL_SAMPLES or KERNEL_LADDER.
// renderer->progress counts launches as tiles and adds to its previous counts. If the observer
// stops the trace, tiles_done stays below tiles and some results are missing.
bool sampler_trace(Renderer *renderer, const FrameData *frame, const SampleList *list,
                   const RenderObserver *observer, Error *error);

// Runs the kernel once on a skipped request, because some drivers finish compiling at the first
// run.
bool sampler_warm_up(Renderer *renderer, Error *error);
