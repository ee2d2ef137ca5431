// SPDX-License-Identifier: MIT
// The times between displayed frames of a moving camera.
#pragma once

#include "base/array.h"

#include <stdint.h>
#include <stdio.h>

typedef struct {
    ARRAY(double) seconds; // from each frame to the next
    double latest;         // time of the latest frame in seconds; 0 without one
} FrameTimes;

// Records a displayed frame of a moving camera. moment is in seconds.
bool frame_times_add(FrameTimes *times, double moment, Error *error);

// Ignores the time to the next frame, because the camera stands still.
void frame_times_pause(FrameTimes *times);

// Prints the statistics. frames is the number of pictures traced while the camera moved. coarse is
// how many of these had fewer pixels than the window.
void frame_times_write(const FrameTimes *times, uint64_t coarse, uint64_t frames, FILE *stream);
void frame_times_free(FrameTimes *times);
