// SPDX-License-Identifier: MIT
// Turns a scene file into Embree's scene and data for shading, in clrt's normalized coordinates.
#pragma once

#include "scene/scene.h"

#include <embree3/rtcore.h>

typedef struct {
    enum RTCBuildQuality quality;
    bool robust;
    uint32_t threads;
    uint32_t width, height; // of the picture; 0: the scene's
} PeerSettings;

// The geometries of Embree's scene. A hit's primID is the index in file order.
typedef enum { PEER_SPHERES, PEER_TRIANGLES } PeerGeometry;

typedef struct {
    RTCDevice device;
    RTCScene scene;
    TriangleLook *looks;    // one per primitive, all spheres first
    CornerNormals *normals; // of the smooth triangles
    Material *materials;
    PointLight *lights;
    uint32_t light_count, sphere_count, triangle_count, material_count;
    float background[3], ambient;
    CameraData camera;
    uint32_t width, height, max_level;
    double build_seconds; // of rtcCommitGeometry and rtcCommitScene
} PeerScene;

// Loads a scene file with its first view and builds Embree's tree. Call peer_scene_close after
// success and after failure.
bool peer_scene_open(PeerScene *peer, const char *path, const PeerSettings *settings, Error *error);
void peer_scene_close(PeerScene *peer);
