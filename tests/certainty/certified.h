// SPDX-License-Identifier: MIT
// A scene -> its picture and the certainty of each pixel, by the same stages as in clrt.
#pragma once

#include "render/aov_pass.h"

// A device that stays open for a group of tests.
typedef struct {
    Device device;
    Cache cache;
} Office;

bool office_open(Office *office, Error *error);
void office_close(Office *office);

typedef struct {
    uint32_t view;          // from 1
    uint32_t width, height; // 0: the scene's
    uint32_t samples;       // per pixel and axis
} CertifiedView;

typedef struct {
    FlatScene flat; // with pair nodes
    CameraData camera;
    RenderSettings settings;
    Framebuffer plain, picture; // without --aov certainty; with repaired pixels
    Layers seen; // the plain picture's first hits: primitive, material, share of lights
    CertaintyMap map;
} Certified;

bool certified_make(Certified *certified, const Office *office, const Scene *scene,
                    const CertifiedView *view, Error *error);
void certified_free(Certified *certified);
