// SPDX-License-Identifier: MIT
// Draws a scene's picture and certifies its pixels, by the stages of clrt.
#pragma once

#include "extremes/support/picture.h"
#include "render/aov.h"

typedef struct {
    uint32_t view; // from 1
    uint32_t width, height;
    uint32_t samples; // N of the N x N samples per pixel
    TreeKind tree;    // for the certificate
} CertifiedView;

typedef struct {
    Stage stage; // with pair nodes
    CameraData camera;
    RenderSettings settings;
    Framebuffer plain, picture; // plain: without --aov certainty; picture: its repaired copy
    Layers seen; // the plain picture's first hits: primitive, material, share of lights
    CertaintyMap map;
} Certified;

// Any failure ends the test. All tests of a program share a studio.
Certified certified_make(const Scene *scene, const CertifiedView *view);
void certified_free(Certified *certified);
