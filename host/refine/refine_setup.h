// SPDX-License-Identifier: MIT
// The inputs of adaptive anti-aliasing, and of error and time goals.
#pragma once

#include "base/thread_pool.h"
#include "image/framebuffer.h"
#include "mesh/mesh_pieces.h"
#include "render/renderer.h"
#include "scene/normalize.h"

typedef struct {
    Renderer *renderer;    // with sample_entry for adaptive anti-aliasing, ladder_entry for goals
    const FlatScene *flat; // the renderer's scene
    const CameraData *camera; // made for REFINE_GRID samples; for goals, LADDER_GRID
    ThreadPool *pool;         // threads for the work, NULL for none
    const Scene *scene;       // the source of flat
    const MeshPieces *pieces; // of each of the scene's objects
    const Normalization *normalization;
    Framebuffer *picture;           // of the renderer's size
    const RenderObserver *observer; // may stop the refinement; may be NULL
} RefineSetup;
