// SPDX-License-Identifier: MIT
// How smoothly a moving camera is shown: the times between frames.
#pragma once

#include "base/array.h"

#include <stdint.h>
#include <stdio.h>

typedef struct {
    ARRAY(double) seconds; // between each frame and the one before
    double latest;         // moment of the latest frame, 0 while there is none
} FrameTimes;

// A frame of a moving camera was shown at that moment.
bool frame_times_add(FrameTimes *times, double moment, Error *error);

// The camera stands still: the time to the next frame counts for nothing.
void frame_times_pause(FrameTimes *times);

// Writes a line of figures; coarse is how many of frames traced pictures had fewer pixels than the
// window.
void frame_times_write(const FrameTimes *times, uint64_t coarse, uint64_t frames, FILE *stream);
void frame_times_free(FrameTimes *times);
