// SPDX-License-Identifier: MIT
// Chooses the next picture to trace, so that the camera moves smoothly and a still picture
// sharpens.  The first picture has as many pixels as a frame's time allows, the next one all
// pixels, then all samples.  The last pass counts rays and tests.
#pragma once

#include <stdbool.h>
#include <stdint.h>

#define PLAN_FRAME_SECONDS (1 / 30.0)

// The requested picture and its cost.
typedef struct {
    bool is_wanted;
    uint64_t subject; // names the scene, camera and size; pictures of other subjects are useless
    uint32_t width, height;
    uint32_t samples;      // per pixel and axis
    double sample_seconds; // per sample, as measured
} PlanRequest;

// The best picture so far.
typedef struct {
    uint64_t subject; // 0 for none
    uint32_t divisor, samples;
    bool is_counted;
} PlanReached;

typedef enum {
    PASS_NONE,
    PASS_MOVING, // within a frame's time; never interrupted, so that something is displayed
    PASS_FULL,   // all pixels, or all samples
    PASS_COUNT   // the same picture with counters
} PassKind;

typedef struct {
    PassKind kind;
    uint32_t divisor; // one traced pixel covers divisor x divisor pixels
    uint32_t samples;
    uint32_t width, height; // of the traced picture
    uint32_t tile;          // side, small enough to stop without delay
} Pass;

Pass plan_pass(const PlanRequest *request, const PlanReached *reached);

// Returns the expected seconds per sample before the first measurement.
double plan_first_guess(uint32_t triangles, bool uses_bvh);
