// SPDX-License-Identifier: MIT
// A finished picture and a reference -> the picture's error.
#pragma once

#include "cli/picture_data.h"

// Appends the error channel to *layers. The error of a pixel is the largest difference between a
// color component of the picture and of the reference. Does nothing if there is no reference, if
// the file's format has no channels, or if --aov has already added the error channel.
void picture_error_name_layer(const Options *options, Layers *layers);

// With --reference, draws the reference of the picture (session/reference.h), measures and prints
// the picture's difference from it, and fills the error channel. Measures nothing if a signal stops
// the picture or the reference.
bool picture_error_measure(Picture *picture, Error *error);

// Writes the reference to the file that the options name, if any.
bool picture_error_write_reference(const Picture *picture, Error *error);
