// SPDX-License-Identifier: MIT
// FlatScene and camera -> the certainty of each pixel's decisions, and the pixels repaired in fp64
// (kernels/certify.cl).
#pragma once

#include "render/renderer.h"

typedef struct {
    Renderer reference; // in fp64; its program contains the kernel
    cl_kernel kernel;
    cl_mem colors, marks; // of a tile, on the device
    float (*host_colors)[3];
    CertaintyMark *host_marks;
} Certifier;

// Prepares to certify an fp32 picture of the same scene and settings.  setup's choice must be
// certifier_choice, and flat must have its node layout and outlive the certifier.  Fails if the
// device has no double arithmetic or does not round float divisions correctly, which the bounds
// require.
bool certifier_open(Certifier *certifier, const RendererSetup *setup, const FlatScene *flat,
                    const RenderSettings *settings, Error *error);
void certifier_close(Certifier *certifier);

KernelChoice certifier_choice(void);

// A mark per pixel, rows from the top.
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

// Fills the map and replaces the colors of repaired pixels, tile by tile, until the observer stops
// it.
bool certifier_certify(const Certifier *certifier, const CameraData *camera,
                       const RenderObserver *observer, const CertifiedPicture *picture,
                       Error *error);
