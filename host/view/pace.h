// SPDX-License-Identifier: MIT
// How smoothly a moving camera is shown: the times between frames.
#pragma once

#include "base/array.h"

#include <stdint.h>
#include <stdio.h>

typedef struct {
    ARRAY(double) seconds; // between each frame and the one before
    double latest;         // moment of the latest frame, 0 while there is none
} Pace;

// A frame of a moving camera was shown at that moment.
bool pace_add(Pace *pace, double moment, Error *error);

// The camera stands still: the time to the next frame counts for nothing.
void pace_pause(Pace *pace);

// Writes a line of figures; coarse is how many of frames traced pictures had fewer pixels than the
// window.
void pace_write(const Pace *pace, uint64_t coarse, uint64_t frames, FILE *stream);
void pace_free(Pace *pace);
