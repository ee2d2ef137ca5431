// SPDX-License-Identifier: MIT
// Draws the picture of a scene file by the stages of clrt.
#pragma once

#include "refine/ladder.h"
#include "render/tile_pass.h"
#include "session/explainer.h"
#include "session/picture.h"

// A callback that receives a picture and an explainer for its pixels.
typedef void PictureVisit(Explainer *explainer, const Framebuffer *picture, void *context);

// A callback that draws the picture. The renderer's kernel is sample_entry (render/sampler.h).
typedef bool PictureDraw(void *context, Renderer *renderer, const CameraData *camera,
                         Framebuffer *picture, Error *error);

typedef struct {
    const char *scene_path;
    const Scene *scene;     // replaces the file's scene; borrowed; NULL: the file's
    bool has_last_tree;     // keeps the tree of the last request, which had the same `scene`
    uint32_t view;          // from 1
    uint32_t width, height; // 0: the scene's
    uint32_t samples;       // N of the N x N samples per pixel
    float contrast;         // refines adaptively down to this contrast; 0: no refinement
    double error_goal;      // refines until the error bound is at most this; 0: no goal
    uint32_t threads;       // of the host, for refined pictures
    uint64_t *sample_count; // receives the samples of a refined picture; or NULL
    int64_t max_level;      // negative: the scene's
    bool uses_bvh;
    BvhBuilder builder;
    uint32_t tile_width, tile_height;
    uint32_t group_width, group_height; // 0: the device's
    uint32_t gpu_units; // draws as on a GPU with this number of compute units; 0: as on the device
    ClrtSpecialize specialization;
    KernelChoice choice;
    const char *extra_options; // for the compiler of kernels; NULL for none
    uint64_t *tallies;         // receives TALLY_KINDS counts; NULL: does not count
    AovSet aovs;               // the channels to store in layers
    Layers *layers;            // the caller frees them; NULL without channels
    PictureVisit *visit;       // called after drawing; NULL for none
    void *visit_context;
    PictureDraw *draw; // replaces clrt's ways of drawing; NULL for none
    void *draw_context;
} PictureRequest;

// Returns clrt's defaults, with the kernels of form_choice and with gpu_units from the environment
// variable CLRT_TEST_GPU. The kernels are not specialized, because
// CLRT_SPECIALIZE_AUTO would depend on the cache.
PictureRequest picture_request(const char *scene_path, uint32_t view);

// Draws on the device named by the environment variable CLRT_DEVICE, or on the best device. The
// caller frees framebuffer.
bool picture_render(Framebuffer *framebuffer, const PictureRequest *request, Error *error);
