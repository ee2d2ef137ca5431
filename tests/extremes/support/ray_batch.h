// SPDX-License-Identifier: MIT
// Traces arrays of rays on the device with the functions of the real kernels (ray_batch.cl).
// Any failure ends the test.
#pragma once

#include "accel/flat.h"
#include "device/cache_build.h"
#include "device/program.h"

// As in kernels/ray.cl.
typedef enum { RAY_CAMERA, RAY_REFLECTED, RAY_SHADOW } RayKind;

// In the normalized frame.
typedef struct {
    float origin[3];
    uint32_t own; // NOTHING for none
    float direction[3];
    uint32_t kind; // a RayKind
} TestRay;

typedef struct {
    float t;     // INFINITY where nothing is met
    uint32_t id; // NOTHING where nothing is met
} TestHit;

typedef enum {
    BATCH_NEAREST, // nearest_hit
    BATCH_BLOCKED, // is_blocked: id 1 or 0
    BATCH_EACH,    // one ray against each triangle: ray_batch_each
    BATCH_BOXES,   // ray_batch_boxes
    BATCH_LEAVE,   // ray_batch_leave
    BATCH_TASKS
} BatchTask;

typedef struct {
    Device device;
    Cache cache;
    Program program;
    cl_kernel kernels[BATCH_TASKS];
    cl_mem rays, hits;
    cl_mem spheres, nodes, triangles, looks, normals; // of the scene
    cl_mem outward;
    uint32_t block_count;
    FrameData frame;
    KernelChoice choice; // form_choice, with a number of lanes
} RayBatch;

// Takes the kernels from a folder; where it is NULL, from the environment variable CLRT_KERNEL_DIR,
// or those that are built in; options are the compiler's, NULL for none.  The device is the one
// that CLRT_DEVICE names, unset the best.
void ray_batch_open(RayBatch *batch, const char *kernel_folder, const char *options);
void ray_batch_close(RayBatch *batch);

// The same as fixtures of a group of tests, which find the batch in *state.
int ray_batch_setup(void **state);
int ray_batch_teardown(void **state);

// Replaces the scene that rays are traced through, which is laid out for form_choice.
void ray_batch_upload(RayBatch *batch, const FlatScene *flat);

// Fills hits[i] from rays[i]; task is BATCH_NEAREST or BATCH_BLOCKED.  Rays from one origin and
// reflected ones go as packets where they can.
void ray_batch_trace(const RayBatch *batch, BatchTask task, const TestRay *rays, size_t count,
                     TestHit *hits);

// Fills one hit for each triangle of the scene, in file order.
void ray_batch_each(const RayBatch *batch, const TestRay *ray, TestHit *hits);

// The id of hits of ray_batch_leave that meet nothing but are shadowed.
#define LEAVE_SHADOWED 0xfffffffeu

// Finds the hit of a ray that leaves the surface hit by rays[i] along outward[i], turned to the
// side that the ray came from. t is 0 without a surface.
void ray_batch_leave(const RayBatch *batch, const TestRay *rays, const float (*outward)[3],
                     size_t count, TestHit *hits);

// Which boxes of nodes[i] does rays[i] meet?  Replaces the scene.
void ray_batch_boxes(RayBatch *batch, const TestRay *rays, const BvhPair *nodes, size_t count,
                     TestHit *hits);
