// SPDX-License-Identifier: MIT
// FlatScene and camera -> the certainty of each pixel, and new colors for pixels repaired in fp64
// (kernels/certify.cl). A pixel is certified if rounding cannot change the hits of its rays, the
// lights that reach the hits, or the squares of checkers at the hits.
#pragma once

#include "image/framebuffer.h"
#include "render/renderer.h"

// The kernel certify_tile. The KernelChoice of this kernel must have CLRT_FP64.
extern const KernelEntry certify_entry;

// Fails on devices without double arithmetic, denormal numbers or correctly rounded float division,
// because the bounds require all three.
bool certifier_check_device(const Device *device, Error *error);

// One mark per pixel, top row first.
typedef struct {
    uint32_t width, height;
    CertaintyMark *marks;             // owned
    uint64_t counts[CERTAINTY_KINDS]; // number of pixels of each Certainty
} CertaintyMap;

bool certainty_map_make(CertaintyMap *map, uint32_t width, uint32_t height, Error *error);
void certainty_map_free(CertaintyMap *map);

// A picture and its marks, both of the size that tile_frame_size stores.
typedef struct {
    Framebuffer *framebuffer;
    CertaintyMap *map;
} CertifiedPicture;

// Fills the map and replaces the colors of repaired pixels, tile by tile. Stops when the observer
// returns false. The renderer's kernel must have certify_entry.
bool certifier_certify(const Renderer *renderer, const CameraData *camera,
                       const RenderObserver *observer, const CertifiedPicture *picture,
                       Error *error);
