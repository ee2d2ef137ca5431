// SPDX-License-Identifier: MIT
// Chooses the next pass that draws the window's picture. The camera thereby moves smoothly, and a
// resting picture becomes sharp (compare Bergman, Fuchs, Grant and Spach, "Image rendering by
// adaptive refinement", 1986). The first pass should take at most a frame's time, at a lower
// resolution if necessary. The next pass traces all pixels with one sample, and another pass traces
// all samples. The last pass counts rays and triangle tests.
#pragma once

#include "session/session.h"

#define PLAN_FRAME_SECONDS (1 / 30.0)

typedef struct {
    bool is_wanted;
    uint64_t subject; // identifies scene, camera and size; pictures of other subjects do not count
    RenderSettings full;   // of the full picture with all samples
    double sample_seconds; // tracing time per sample, first guessed, then measured
} PlanRequest;

// The best complete picture so far.
typedef struct {
    uint64_t subject; // 0 for none
    uint32_t divisor, samples;
    bool is_counted;
} PlanReached;

typedef enum {
    PASS_NONE,
    PASS_MOVING, // takes about a frame's time; a moving camera does not stop this pass at once
    PASS_FULL,   // all pixels, with one sample or with all samples
    PASS_COUNT   // the full picture again, with counters
} PassKind;

typedef struct {
    PassKind kind;
    uint32_t divisor;        // one traced pixel covers divisor x divisor pixels
    RenderSettings settings; // of the traced picture; tiles are small, so that passes stop quickly
} Pass;

Pass plan_pass(const PlanRequest *request, const PlanReached *reached);

// Returns the expected seconds per sample before the first measurement.
double plan_first_guess(uint32_t triangles, bool uses_bvh);
