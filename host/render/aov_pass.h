// SPDX-License-Identifier: MIT
// The scene of a renderer -> the channels of a picture.  Separate kernels compute them, so pictures
// without channels pay nothing.
#pragma once

#include "render/aov.h"
#include "render/certifier.h"

typedef struct {
    const RendererSetup *setup;
    const Renderer *renderer; // the renderer of the picture
    CameraData camera;        // of the picture
    CameraData center;        // the same camera with one sample a pixel
    const uint32_t *samples;  // of each pixel, row by row; NULL if all have the same number
    AovScene scene;
    const CertaintyMap *certainty; // of the picture; NULL if no channel needs it
} AovSource;

typedef struct {
    const AovSource *source;
    AovSet set;
    bool counts_tests;
    Program program;
    cl_kernel trace_paths, count_tests;
    cl_mem paths, tests; // of a tile, on the device
    PathData *host_paths;
    uint32_t (*host_tests)[TALLY_KINDS];
} AovPass;

// Compiles the kernels for the channels of set; source must outlive the pass.
bool aov_pass_open(AovPass *pass, AovSet set, const AovSource *source, Error *error);
void aov_pass_close(AovPass *pass);

// Fills layers until the observer stops it.  layers must have the names of the set and the
// picture's size.
bool aov_pass_draw(const AovPass *pass, const RenderObserver *observer, Layers *layers,
                   Error *error);
