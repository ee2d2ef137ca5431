// SPDX-License-Identifier: MIT
// Measures how much each pixel of a picture with one sample per pixel bends away from its
// neighbors.
#pragma once

#include "base/thread_pool.h"
#include "image/framebuffer.h"

// Fills bends with a value for each pixel, row by row: twice the largest difference of one of its
// colors from the mean of two opposite neighbors, as a fraction. Neighbors outside of the picture
// do not count.
void bends_measure(const Framebuffer *picture, ThreadPool *pool, float *bends);

// Fills nearby with the largest bend of the 5 x 5 pixels around each pixel.
void bends_spread(const Framebuffer *picture, ThreadPool *pool, const float *bends, float *nearby);
