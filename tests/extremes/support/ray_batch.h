// SPDX-License-Identifier: MIT
// Traces arrays of rays on the device with the functions of clrt's kernels (ray_batch.cl). Any
// failure ends the test.
#pragma once

#include "accel/flat.h"
#include "device/program.h"

// Equals the RayKind of kernels/ray.cl.
typedef enum { RAY_CAMERA, RAY_REFLECTED, RAY_SHADOW } RayKind;

// A ray in normalized coordinates.
typedef struct {
    float origin[3];
    uint32_t own; // id of the primitive that the ray starts on; NOTHING for none
    float direction[3];
    uint32_t kind; // a RayKind
} TestRay;

typedef struct {
    float t;     // INFINITY without a hit
    uint32_t id; // NOTHING without a hit
} TestHit;

typedef struct {
    TestRay *data;
    size_t count;
} Rays;

typedef enum {
    BATCH_NEAREST, // nearest_hit
    BATCH_BLOCKED, // blocking_hits: t is 0; id is 1 if blocked, else 0
    BATCH_LEAVE,   // ray_batch_leave
    BATCH_TASKS
} BatchTask;

typedef struct {
    Device device;
    Program program;
    cl_kernel kernels[BATCH_TASKS];
    cl_mem rays, hits, outward;
    cl_mem arrays[FLAT_ARRAYS]; // of the scene
    FrameData frame;
    bool is_changed;     // the kernels are not clrt's own, or compiled with other options
    KernelChoice choice; // form_choice; with wide nodes, lanes is not 0
} RayBatch;

// Opens the device that CLRT_DEVICE names or, without this variable, device_open's default. If
// kernel_folder is NULL, uses the kernels in CLRT_KERNEL_DIR, or else the built-in kernels. options
// for the compiler may be NULL.
void ray_batch_open(RayBatch *batch, const char *kernel_folder, const char *options);
void ray_batch_close(RayBatch *batch);

// Fixtures of a group of tests. *state is the batch.
int ray_batch_setup(void **state);
int ray_batch_teardown(void **state);

// Replaces the scene with a copy of flat, which must have the layout of form_choice.
void ray_batch_upload(RayBatch *batch, const FlatScene *flat);

// Replaces the scene with a single sphere.
void ray_batch_upload_sphere(RayBatch *batch, const SphereData *sphere);

// Returns the hits in the order of `rays`; the caller frees them. task is BATCH_NEAREST or
// BATCH_BLOCKED. Traces the rays sorted by kind, signs of the direction, and origin, so that
// packets hold similar rays.
TestHit *ray_batch_trace(const RayBatch *batch, BatchTask task, Rays rays);

// The id that ray_batch_leave returns if a ray from the surface hits nothing, but a shadow ray from
// the same point in the same direction is blocked.
#define LEAVE_SHADOWED 0xfffffffeu

// Returns the hits of rays that leave the surfaces hit by `rays`. Ray i has the direction
// outward[i] or its opposite, whichever points to the side from which rays.data[i] came. t is 0 if
// rays.data[i] hits nothing.
TestHit *ray_batch_leave(const RayBatch *batch, Rays rays, const float (*outward)[3]);
