// SPDX-License-Identifier: MIT
// Traces rays in a scene on the device, with libclrt, and perhaps with Embree (peers.h). A judge
// examines the hits.
#pragma once

#include "library_tracer.h"
#include "peers.h"
#include "rays.h"

typedef struct {
    const char *test;
    RayBatch *batch;
    Stage stage;
    LibraryTracer library;
    Peers peers;
} Rig;

// Builds the scene's tree, uploads the scene and the tree to the batch, and frees the scene.
Rig rig_open(const char *test, RayBatch *batch, Scene scene);
Rig rig_open_with(const char *test, RayBatch *batch, Scene scene, TreeKind tree);
void rig_close(Rig *rig);

// A ray and its hit by one of the ray tracers.
typedef struct {
    const TestRay *ray;
    const TestHit *hit;
    size_t index; // of the ray
    RayTracer tracer;
} Traced;

// Returns whether the hit is wrong. context is the judge's own.
typedef bool Judge(void *context, const Traced *traced);

// Traces the rays, and returns how many hits of each tracer are wrong.
Outcome rig_judge(const Rig *rig, Rays rays, Judge *is_wrong, void *context);

// A judge for rays that must hit: a ray is wrong if it hits nothing, or if its distance is not
// finite.
bool judge_misses(void *unused, const Traced *traced);

// A judge whose context is the stage's Triangles. A hit is wrong if the verdict of exact_nearest is
// clear and has another id.
bool judge_exactly(void *triangles, const Traced *traced);
