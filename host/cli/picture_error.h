// SPDX-License-Identifier: MIT
// Computes the certainty of a finished picture, and the picture's error against a reference.
#pragma once

#include "cli/picture_data.h"

// Appends the error channel to *layers. The error of a pixel is the largest difference between its
// color components and the reference's. Does nothing if there is no reference, if the file's format
// has no channels, or if --aov has already added the error channel.
void reference_name_layer(const Options *options, Layers *layers);

// With --reference, draws the reference of the picture (session/reference.h), measures and prints
// the picture's difference from it, and fills the error channel. Measures nothing if a signal stops
// the picture or the reference.
bool reference_measure(Picture *picture, Error *error);

// Writes the reference to the file that the options name, if any.
bool reference_write(const Picture *picture, Error *error);

// With --aov certainty, computes the certainty of each pixel of a finished picture. If only fp64 is
// exact enough for a pixel, the pixel gets the color that fp64 yields. Does nothing to a picture
// that was stopped.
bool picture_certify(Picture *picture, Error *error);
