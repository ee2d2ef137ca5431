// SPDX-License-Identifier: MIT
// The times between displayed frames of a moving camera.
#pragma once

#include "base/array.h"

#include <stdint.h>
#include <stdio.h>

typedef struct {
    ARRAY(double) seconds; // from each frame to the next
    double
        latest; // time of the latest frame in seconds; 0 without one or if the camera has stopped
} FrameTimes;

// Records a displayed frame of a moving camera. moment is in seconds.
bool frame_times_add(FrameTimes *times, double moment, Error *error);

// Prints the statistics. frames is the number of pictures traced while the camera moved. coarse is
// how many of these had fewer pixels than the window.
void frame_times_write(const FrameTimes *times, uint64_t coarse, uint64_t frames, FILE *stream);
void frame_times_free(FrameTimes *times);
