// SPDX-License-Identifier: MIT
// The session's scene, prepared for rays of the caller. It exists twice: in device buffers that
// kernels search, and as triangles on the host, from which callers compute the positions of hits.
// All triangles are two-sided unless the caller sets one_sided.
#pragma once

#include "session/session.h"

typedef struct {
    uint32_t index;  // in the device's arrays
    uint32_t mesh;   // number of the mesh
    uint32_t number; // in the mesh as given, counting the triangles that clrt drops
} TrianglePlace;

typedef struct {
    SceneForm form;        // its triangles are as traced, in the order of their ids
    TrianglePlace *places; // of the triangles
    bool is_loaded, one_sided;
} RayScene;

// Compiles the session's scene in a layout of nodes, unless ray_scene already has the scene with
// this value of one_sided. A RayScene must always get the same layout. If compiling fails,
// ray_scene is left without a scene.
bool ray_scene_take(RayScene *ray_scene, Session *session, NodeLayout layout, bool one_sided,
                    Error *error);

// Releases the scene. The session's scene may change afterwards.
void ray_scene_free(RayScene *ray_scene);
