// SPDX-License-Identifier: MIT
// PeerScene -> Framebuffer, in one of the ways to call Embree.
#pragma once

#include "image/framebuffer.h"
#include "peer_scene.h"

typedef enum { RAY_CAMERA, RAY_SHADOW, RAY_REFLECTED, RAY_KINDS } RayKind;

typedef struct {
    uint64_t rays[RAY_KINDS];
} PeerCounts;

// One tile of a picture on one thread.
typedef struct {
    const PeerScene *scene;
    enum RTCIntersectContextFlags flags[RAY_KINDS];
    Framebuffer *framebuffer;
    uint32_t x, y, width, height;
    PeerCounts counts; // added to
} PeerTile;

// A way to call Embree; draw_tile is peer_tile.c, compiled for it.
typedef struct {
    const char *name;
    void (*draw_tile)(PeerTile *tile);
} PeerMode;

extern const PeerMode peer_modes[];
extern const int peer_mode_count;

// A picture in this mode. flags are Embree's context flags for each kind of ray.
typedef struct {
    const PeerScene *scene;
    const PeerMode *mode;
    enum RTCIntersectContextFlags flags[RAY_KINDS];
    uint32_t threads;
} PeerPicture;

// Fills the framebuffer, which has the scene's size, and counts the rays it took.
PeerCounts peer_draw(const PeerPicture *picture, Framebuffer *framebuffer);
