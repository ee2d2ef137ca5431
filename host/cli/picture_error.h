// SPDX-License-Identifier: MIT
// Computes a finished picture's certainty, and its error against a reference.
#pragma once

#include "cli/picture_data.h"

// Appends the error channel. The error of a pixel is the largest difference of its colors from the
// reference. Does nothing if there is no reference, if the file's format has no channels, or if
// --aov has already added the error channel.
void reference_name_layer(const Options *options, Layers *layers);

// With --reference, draws the reference of the picture (session/reference.h), measures and prints
// the picture's difference from it, and fills the error channel. Measures nothing if a signal stops
// the picture or the reference.
bool reference_measure(Picture *picture, Error *error);

// Writes the reference to the file that the options name, if any.
bool reference_write(const Picture *picture, Error *error);

// With --aov certainty, computes the certainty of each pixel of a finished picture. If only fp64 is
// exact enough for a pixel, replaces the pixel's color. Does nothing to a picture that was stopped.
bool picture_certify(Picture *picture, Error *error);
