// SPDX-License-Identifier: MIT
// A picture -> how far it is from the true one: the same view is drawn again in fp64, with many
// samples that are not the picture's.
#pragma once

#include "cli/run.h"

// Adds the channel of each pixel's error behind the others, where one is asked for and the file's
// format takes it: the largest difference of its colors.
void reference_name_layer(const Options *options, Layers *layers);

// Draws the reference of run's picture into run->reference, and measures the difference,
// which goes to the channel as well.  Its rays
// are followed as far as the scene or the picture's settings say, whichever is farther.  A
// picture that was stopped is not measured, nor one whose reference is.
bool reference_measure(Run *run, Error *error);

// Writes the reference, in the format of the path's ending.
bool reference_write(const Run *run, const char *path, Error *error);
