// SPDX-License-Identifier: MIT
// The steps of a picture in a file: drawing it with as many samples per pixel as it needs,
// certifying it, and measuring its error against a reference.
#pragma once

#include "cli/run.h"

// A reference is the same view drawn again in fp64, with many samples different from the picture's.

// Adds the channel of each pixel's error, the largest difference of its colors, after the others.
// Does nothing unless the options request it and the file's format supports it.
void reference_name_layer(const Options *options, Layers *layers);

// Draws the reference of run's picture into run->reference, measures the difference and fills the
// error channel.  Its rays reach the level of the scene or of the picture's settings, whichever is
// higher.  If the picture or its reference is stopped, nothing is measured.
bool reference_measure(Run *run, Error *error);

// Writes the reference, in the format of the path's ending.
bool reference_write(const Run *run, const char *path, Error *error);

// Draws the run's picture and stores its cost in the report.
bool refined_picture_draw(Run *run, const CameraData *camera, const RenderObserver *observer,
                          Error *error);

// Computes the certainty of each pixel and repairs pixels in fp64: fills the run's certainty,
// repairs its finished picture and stores the counts in its report.  A stopped picture stays
// unchanged, without any certified pixel.
bool certain_picture_make(Run *run, const CameraData *camera, Error *error);
