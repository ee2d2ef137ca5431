// SPDX-License-Identifier: MIT
// Draws scenes on one device that stays open for a group of tests, and judges the pictures.
// Any failure ends the test.
#pragma once

#include "outcome.h"
#include "render/tile_pass.h"
#include "stage.h"

typedef struct {
    Device device;
} Studio;

// Fixtures of a group of tests. *state is the studio. CLRT_DEVICE names the studio's device.
// Without this variable, device_open chooses the device.
int picture_setup(void **state);
int picture_teardown(void **state);

typedef struct {
    TreeKind tree;
    RenderSettings render;
    KernelChoice choice;
    const char *extra_options; // for the kernels' compiler; NULL for none
} PictureSettings;

// Returns settings for side x side pixels with one sample each, in tiles of 32 x 32 pixels. The
// program has the form of form_choice and is not specialized.
PictureSettings picture_settings(uint32_t side);

// A scene that is ready to draw.
typedef struct {
    Stage stage;
    SceneBuffers buffers;
    KernelSet kernels;
    Renderer renderer;
} OpenPicture;

// Opens a picture with the kernels in CLRT_KERNEL_DIR, or the built-in kernels. The picture must
// stay at its address until picture_close.
void picture_open(OpenPicture *picture, const Studio *studio, const Scene *scene,
                  const PictureSettings *settings);
void picture_close(OpenPicture *picture);

// Returns the camera of the scene's first viewpoint.
CameraData picture_camera(const Scene *scene, const RenderSettings *settings);

// Draws the scene's first viewpoint. The caller frees the picture.
Framebuffer picture_draw(const Studio *studio, const Scene *scene, const PictureSettings *settings);

// Draws like picture_draw, and frees the scene.
Framebuffer picture_draw_once(const Studio *studio, Scene scene, const PictureSettings *settings);

size_t picture_pixels(const Framebuffer *picture);

// Returns how many pixels of `other` differ in any bit from `usual`. Frees `other`.
Outcome picture_compare(const char *test, const Framebuffer *usual, Framebuffer other);

// Returns how many pixels differ from the oracle's without an explanation by the oracle, plus how
// many values are faulty. Frees the scene.
Outcome picture_judge(const char *test, const Studio *studio, Scene scene,
                      const PictureSettings *settings);

// Judges like picture_judge, but the oracle draws `exact` instead of the scene. Frees both.
Outcome picture_judge_beside(const char *test, const Studio *studio, Scene scene, Scene exact,
                             const PictureSettings *settings);

// Returns how many values are NaN or outside [0, 1].
size_t picture_count_faults(const Framebuffer *picture);

// Returns how many pixels differ from color.
size_t picture_count_other(const Framebuffer *picture, const float color[3]);
