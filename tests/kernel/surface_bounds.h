// SPDX-License-Identifier: MIT
// The parts that the files of test_surface_bounds share.
#pragma once

#include "kernel/bound_math.h"
#include "kernel/probe.h"
#include "scene/scene.h"

#define CASES 4096

// The kernels of surface_bounds.cl.
extern Probe surface_probe, surface_probe_fp64;

// A bound, and the largest error divided by the bound so far.
typedef struct {
    const char *name;
    double share;
} Share;

// Returns whether the error's share of the bound is the largest so far.
bool share_note(Share *share, Quad error, Quad most);

// Prints all shares. Fails if a share exceeds 1, or if a bound has no case.
void shares_check(const Share *shares, int count);

// Returns the number of rounds of CASES cases.
int bound_rounds(void);

// Runs a kernel with two inputs, and fails if it cannot.
#define RUN_PROBE(probe, kernel, first, second, output)                                            \
    assert_true(probe_run(&(probe), kernel,                                                        \
                          (const ProbeInput[]){{first, sizeof(first)}, {second, sizeof(second)}},  \
                          CASES, (ProbeInput){output, sizeof(output)}))

// A ray and the parameters of its case.
typedef struct {
    float origin[3], direction[3], given[3];
} SurfaceCase;

// Makes a random triangle with coordinates in [-1, 1], and a random ray that hits it. The ray often
// hits the triangle near an edge or a corner.
void surface_case_make(uint64_t *seed, SurfaceCase *made, TriangleData *triangle);

// Sends the ray of a case to a random point of the triangle, often near an edge or a corner.
void surface_case_aim(uint64_t *seed, SurfaceCase *made, const TriangleData *triangle);
