// SPDX-License-Identifier: MIT
// A picture -> its error against a reference: the same view drawn again in fp64, with many samples
// different from the picture's.
#pragma once

#include "cli/run.h"

// Adds the channel of each pixel's error, the largest difference of its colors, after the others.
// Does nothing unless the options request it and the file's format supports it.
void reference_name_layer(const Options *options, Layers *layers);

// Draws the reference of run's picture into run->reference, measures the difference and fills the
// error channel.  Its rays reach the level of the scene or of the picture's settings, whichever is
// higher.  If the picture or its reference is stopped, nothing is measured.
bool reference_measure(Run *run, Error *error);

// Writes the reference, in the format of the path's ending.
bool reference_write(const Run *run, const char *path, Error *error);
