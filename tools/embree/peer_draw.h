// SPDX-License-Identifier: MIT
// Draws a PeerScene into a Framebuffer in one of several modes, which are ways to call Embree.
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
    PeerCounts counts; // of all tiles of the thread so far
} PeerTile;

// A way to call Embree. draw_tile is the function of peer_tile.c, compiled for the mode.
typedef struct {
    const char *name;
    void (*draw_tile)(PeerTile *tile);
} PeerMode;

extern const PeerMode peer_modes[];
extern const int peer_mode_count;

// A picture to draw. flags are Embree's context flags for each kind of ray.
typedef struct {
    const PeerScene *scene;
    const PeerMode *mode;
    enum RTCIntersectContextFlags flags[RAY_KINDS];
    uint32_t threads;
} PeerPicture;

// Fills the framebuffer, which must have the scene's size. Returns the number of traced rays of
// each kind.
PeerCounts peer_draw(const PeerPicture *picture, Framebuffer *framebuffer);
