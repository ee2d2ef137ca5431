// SPDX-License-Identifier: MIT
// Traces rays with Embree 3 if it is installed and CLRT_TEST_PEERS is set. Embree does not
// normalize, so it gets the scene's coordinates.
#pragma once

#include "outcome.h"
#include "ray_batch.h"
#include "stage.h"

typedef struct {
    void *device; // NULL without Embree
    void *scenes[TRACERS];
    Normalization normalization;
} Peers;

// Opens Embree with the stage's triangles, unless the stage has spheres or no triangles.
void peers_open(Peers *peers, const Stage *stage);
void peers_close(Peers *peers);

// Returns the rays' hits by one of Embree's modes. The caller frees them.
TestHit *peers_trace(const Peers *peers, RayTracer tracer, Rays rays);
