// SPDX-License-Identifier: MIT
// A scene -> the channels of --aov. Separate kernels compute the channels, so pictures without
// channels take no extra time.
#pragma once

#include "render/aov.h"
#include "render/certifier.h"

// The kernels trace_paths and count_tests can share a program. count_tests needs
// SceneTraits::statistics.
extern const KernelEntry paths_entry, tests_entry;

typedef struct {
    AovSet set;
    Renderer paths;          // with paths_entry and the picture's settings
    const Kernel *tests;     // with tests_entry; NULL unless a channel needs it
    CameraData camera;       // the picture's camera
    CameraData center;       // the same camera with one sample per pixel
    const uint32_t *samples; // sample counts of the pixels, row by row; NULL if all are equal
    AovScene scene;
    const CertaintyMap *certainty; // the picture's map; NULL if no channel needs it
} AovPass;

// Computes the channels into `layers`, tile by tile. Stops when the observer returns false.
// `layers` must have the names of pass->set (aov_name_layers) and the picture's size.
bool aov_pass_draw(const AovPass *pass, const RenderObserver *observer, Layers *layers,
                   Error *error);
