// SPDX-License-Identifier: MIT
// Renderer and camera -> a picture.
#pragma once

#include "image/framebuffer.h"
#include "render/renderer.h"

// The kernel render_tile.
extern const KernelEntry draw_entry;

// Draws the camera's picture into framebuffer. Fails if the framebuffer's size differs from
// tile_frame_size. If the observer stops the picture early, the call returns true, and
// renderer->progress has fewer tiles_done than tiles.
bool renderer_draw(Renderer *renderer, const CameraData *camera, const RenderObserver *observer,
                   Framebuffer *framebuffer, Error *error);
