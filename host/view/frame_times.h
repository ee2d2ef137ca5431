// SPDX-License-Identifier: MIT
// The times between displayed frames of a moving camera.
#pragma once

#include "base/array.h"

#include <stdint.h>
#include <stdio.h>

typedef struct {
    ARRAY(double) seconds; // from each frame to the next
    double latest;         // time of the latest frame; 0 for none
} FrameTimes;

// Records a displayed frame of a moving camera.
bool frame_times_add(FrameTimes *times, double moment, Error *error);

// Ignores the time to the next frame, because the camera stands still.
void frame_times_pause(FrameTimes *times);

// Prints the statistics.  coarse is the number of traced pictures, out of frames, with fewer pixels
// than the window.
void frame_times_write(const FrameTimes *times, uint64_t coarse, uint64_t frames, FILE *stream);
void frame_times_free(FrameTimes *times);
