// SPDX-License-Identifier: MIT
// A renderer's scene -> the channels of --aov. Separate kernels compute the channels, so pictures
// without channels take no extra time.
#pragma once

#include "render/aov.h"
#include "render/certifier.h"

typedef struct {
    const RendererSetup *setup;
    const Renderer *renderer; // the renderer that drew the picture
    CameraData camera;        // the picture's camera
    CameraData center;        // the same camera with one sample per pixel
    const uint32_t *samples;  // sample counts of the pixels, row by row; NULL if all are equal
    AovScene scene;
    const CertaintyMap *certainty; // the picture's map; NULL if no channel needs it
} AovSource;

typedef struct {
    const AovSource *source;
    AovSet set;
    bool counts_tests;
    Program program;
    cl_kernel trace_paths, count_tests;
} AovPass;

// Builds the kernels for the channels in set. source must outlive the pass.
bool aov_pass_open(AovPass *pass, AovSet set, const AovSource *source, Error *error);
void aov_pass_close(AovPass *pass);

// Computes the channels into layers, tile by tile, until the observer returns false. layers must
// have the names of set (aov_name_layers) and the picture's size.
bool aov_pass_draw(const AovPass *pass, const RenderObserver *observer, Layers *layers,
                   Error *error);
