// SPDX-License-Identifier: MIT
// Which picture to trace next, so that the camera moves smoothly and what stands still sharpens:
// first one of as many pixels as the time of a frame allows, then one of all pixels, then with all
// samples.  What it cost is counted last of all.
#pragma once

#include <stdbool.h>
#include <stdint.h>

#define PLAN_FRAME_SECONDS (1 / 30.0)

// What is wanted, and how dear it is.
typedef struct {
    bool is_wanted;
    uint64_t subject; // names the scene, camera and size: a picture of another one is of no use
    uint32_t width, height;
    uint32_t samples;      // per pixel and axis
    double sample_seconds; // that tracing one takes, as measured
} PlanRequest;

// The best picture there is.
typedef struct {
    uint64_t subject; // 0 while there is none
    uint32_t divisor, samples;
    bool is_counted;
} PlanReached;

typedef enum {
    PASS_NONE,
    PASS_MOVING, // in the time of a frame; not interrupted, else nothing would be seen
    PASS_FULL,   // all pixels, or all samples
    PASS_COUNT   // the same again, for its counters
} PassKind;

typedef struct {
    PassKind kind;
    uint32_t divisor; // a pixel is traced for so many a side
    uint32_t samples;
    uint32_t width, height; // traced
    uint32_t tile;          // side, so small that stopping takes no time
} Pass;

Pass plan_pass(const PlanRequest *request, const PlanReached *reached);

// What a sample may be expected to take before any was traced.
double plan_first_guess(uint32_t triangles, bool uses_bvh);
