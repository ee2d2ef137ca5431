// SPDX-License-Identifier: MIT
// A finished picture -> its certainty, and its error against a reference.
#pragma once

#include "cli/picture_data.h"

// Appends the channel of each pixel's error: the largest difference of its colors from the
// reference. Does nothing without a reference, without channels in the file's format, or if --aov
// already lists the channel.
void reference_name_layer(const Options *options, Layers *layers);

// With --reference, renders the view again with many other samples and the accuracy of fp64, into
// picture->reference. Measures and prints the difference, and fills the error channel. The
// reference's rays reach the level of the scene or of the settings, whichever is higher. Measures
// nothing if a signal stops the picture or the reference.
bool reference_measure(Picture *picture, Error *error);

// Writes the reference to the file that the options name, if any.
bool reference_write(const Picture *picture, Error *error);

// With --aov certainty, computes the certainty of each pixel of a finished picture, and repairs
// pixels in fp64. If the picture was stopped earlier, it stays unchanged and uncertified.
bool picture_certify(Picture *picture, Error *error);
