// SPDX-License-Identifier: MIT
// Scene -> Framebuffer on one device that stays open for a group of tests.
// Any failure ends the test.
#pragma once

#include "render/renderer.h"
#include "stage.h"

typedef struct {
    Device device;
    Cache cache;
} Studio;

// Fixtures of a group of tests, which find the studio in *state.  The device is the one that the
// environment variable CLRT_DEVICE names, unset the best.
int picture_setup(void **state);
int picture_teardown(void **state);

typedef struct {
    TreeKind tree;
    RenderSettings render;
    KernelChoice choice;
    const char *extra_options; // for the kernels' compiler, NULL for none
} PictureSettings;

// 64 x 64 pixels of one sample in tiles of 32 x 32, drawn by the general program of form_choice.
PictureSettings picture_settings(void);

// Opens a renderer for the scene; kernels are those that are built in, or CLRT_KERNEL_DIR's.  The
// caller closes it and frees the stage after it: the device may read the scene where it lies.
void picture_open(Renderer *renderer, Stage *stage, const Studio *studio, const Scene *scene,
                  const PictureSettings *settings);

// The first of the scene's viewpoints, as the renderer's settings want it.
CameraData picture_camera(const Scene *scene, const RenderSettings *settings);

// Draws the scene's first viewpoint; the caller frees framebuffer.
void picture_draw(Framebuffer *framebuffer, const Studio *studio, const Scene *scene,
                  const PictureSettings *settings);

// The same, and what it cost: settings ask for statistics.
void picture_draw_counted(Framebuffer *framebuffer, const Studio *studio, const Scene *scene,
                          const PictureSettings *settings, RenderProgress *progress);

// How many pixels differ in any bit.
size_t picture_count_differences(const Framebuffer *a, const Framebuffer *b);

// How many pixels hold a value outside [0, 1] or none.
size_t picture_count_faults(const Framebuffer *framebuffer);

// How many pixels differ from the one in the top left corner, which shows the background.
size_t picture_count_covered(const Framebuffer *framebuffer);
