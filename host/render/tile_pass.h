// SPDX-License-Identifier: MIT
// TilePass and Renderer -> values for each pixel. Camera and Renderer -> a picture.
#pragma once

#include "image/framebuffer.h"
#include "render/renderer.h"

// A pass over the tiles from `first` on, by a kernel that computes values for each pixel. The
// kernel's arguments are the frame, the scene's arrays and the outputs.
typedef struct {
    FrameData frame;          // without a tile
    size_t sizes[2];          // bytes per pixel of each output; 0 if the kernel does not write it
    uint64_t first;           // the number of the first tile to draw
    Framebuffer *framebuffer; // receives the first output; NULL if `take` receives it
    // Receives each launch's outputs, row by row, except for an output that `framebuffer` receives.
    // `tile` is the launch's rectangle (tile_next). The rectangles come in the order of tile
    // numbers.
    void (*take)(void *context, const Tile *tile, void *const values[2]);
    void *context;
} TilePass;

// Runs the renderer's kernel for the tiles from pass->first on. Stops when the observer returns
// false. Adds each finished tile to *progress.
bool tile_pass_run(const TilePass *pass, const Renderer *renderer, const RenderObserver *observer,
                   RenderProgress *progress, Error *error);

// The kernel render_tile.
extern const KernelEntry draw_entry;

// Draws the tiles of the camera's picture from settings.ready_tiles on into `framebuffer`. Fails if
// the framebuffer's size differs from tile_frame_size. If the observer stops the picture early, the
// call returns true, and renderer->progress has fewer tiles_done than tiles.
bool tile_pass_draw(Renderer *renderer, const CameraData *camera, const RenderObserver *observer,
                    Framebuffer *framebuffer, Error *error);
