// SPDX-License-Identifier: MIT
// A scene file as Embree traces it and as the peer shades it, in clrt's normalized frame.
#pragma once

#include "scene/scene.h"

#include <embree3/rtcore.h>

typedef struct {
    enum RTCBuildQuality quality;
    bool robust;
    uint32_t threads;
    uint32_t width, height; // of the picture; 0: the scene's
} PeerSettings;

// One geometry holds all triangles; a hit's primID is a triangle in file order.
typedef struct {
    RTCDevice device;
    RTCScene scene;
    TriangleLook *looks;    // by triangle
    CornerNormals *normals; // of the smooth triangles
    Material *materials;
    PointLight *lights;
    uint32_t light_count, triangle_count, material_count;
    float background[3], ambient;
    CameraData camera;
    uint32_t width, height, max_level;
    double build_seconds; // of rtcCommitScene
} PeerScene;

// Loads the scene's first view and builds Embree's tree.  The peer is to be closed in either case.
bool peer_scene_open(PeerScene *peer, const char *path, const PeerSettings *settings, Error *error);
void peer_scene_close(PeerScene *peer);
