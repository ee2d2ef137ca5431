// SPDX-License-Identifier: MIT
// FlatScene and camera -> how certain each pixel's decisions are, and the pixels that fp64 repairs
// (kernels/certify.cl).
#pragma once

#include "render/renderer.h"

typedef struct {
    Renderer reference; // in fp64, from whose program the kernel is
    cl_kernel kernel;
    cl_mem colors, marks; // of a tile, on the device
    float (*host_colors)[3];
    CertaintyMark *host_marks;
} Certifier;

// What is certified is a picture of the same scene and settings in fp32.  Setup's choice is
// certifier_choice and the scene flattened for its nodes; it outlives the certifier.  Fails where
// the device has no double arithmetic, or divides floats too coarsely for the bounds to hold.
bool certifier_open(Certifier *certifier, const RendererSetup *setup, const FlatScene *flat,
                    const RenderSettings *settings, Error *error);
void certifier_close(Certifier *certifier);

KernelChoice certifier_choice(void);

// A mark for each pixel, rows from the top.
typedef struct {
    uint32_t width, height;
    CertaintyMark *marks;             // owned
    uint64_t counts[CERTAINTY_KINDS]; // of pixels
} CertaintyMap;

bool certainty_map_make(CertaintyMap *map, uint32_t width, uint32_t height, Error *error);
void certainty_map_free(CertaintyMap *map);

// A picture and its marks, both of the settings' size.
typedef struct {
    Framebuffer *framebuffer;
    CertaintyMap *map;
} CertifiedPicture;

// Fills the map and gives the repaired pixels their colors, tile by tile, as far as the observer
// lets it.
bool certifier_certify(const Certifier *certifier, const CameraData *camera,
                       const RenderObserver *observer, const CertifiedPicture *picture,
                       Error *error);
