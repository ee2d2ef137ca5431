// SPDX-License-Identifier: MIT
// A scene file -> its picture, by the same stages as the program's main, for tests.
#pragma once

#include "explain/explainer.h"
#include "refine/adaptive.h"
#include "refine/goal.h"
#include "render/aov.h"

// Is shown a picture, and an explainer of its pixels.
typedef void PictureVisit(Explainer *explainer, const Framebuffer *picture, void *context);

typedef struct {
    const char *scene_path;
    uint32_t view;          // from 1
    uint32_t width, height; // 0: the scene's
    uint32_t samples;       // per pixel and axis
    float contrasts[2];     // each above 0 refines the picture adaptively, in that order
    double error_goal;      // refines until the error is estimated to be that
    uint32_t threads;       // of the host, adaptively
    uint64_t *sample_count; // left here, adaptively; or NULL
    int64_t max_level;      // negative: the scene's
    bool uses_bvh;
    BvhBuilder builder;
    uint32_t tile_width, tile_height, group_width, group_height;
    Specialization specialization;
    KernelChoice choice;
    const char *extra_options; // for the kernels' compiler, NULL for none
    uint64_t *tallies;         // TALLY_KINDS counts are left here; NULL counts nothing
    AovSet aovs;               // channels to be left in layers
    Layers *layers;            // which the caller frees; NULL where there are none
    PictureVisit *visit;       // called once the picture is drawn; NULL for none
    void *visit_context;
} PictureRequest;

// Returns the program's defaults with the kernels of form_choice, always in the general form: the
// choice of "auto" depends on the cache.
PictureRequest picture_request(const char *scene_path, uint32_t view);

// Draws on the device that the environment variable CLRT_DEVICE names (unset: the best).
// The caller frees framebuffer.
bool picture_render(Framebuffer *framebuffer, const PictureRequest *request, Error *error);
