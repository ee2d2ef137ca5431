// SPDX-License-Identifier: MIT
// Messages about a picture other than reports.
#pragma once

#include "cli/picture_data.h"

// Prints a note if the error goal is so large that the user may have meant a percentage.
void picture_warn_of_goal(const Options *options);

// Prints a note if the parts of the picture have so few tiles that the parts may take very
// different times.
void picture_warn_of_few_tiles(const Options *options, const RenderSettings *settings);

// With --verbose, prints the path of the frame to draw, if there are several frames. With --resume,
// also prints the number of tiles that earlier runs have finished.
void picture_print_beginning(const Picture *picture);

// On a terminal, without --quiet, and unless the picture goes to standard output, prints the file's
// name, the picture's size and the seconds since picture->moment. Sets picture->moment to the
// current time.
void picture_print_end(Picture *picture);

// These functions fill *error for a picture that misses its goal or is stopped. They return the
// exit status.
ExitCode picture_fail_goal(const Picture *picture, Error *error);
ExitCode picture_fail_stopped(const Picture *picture, Error *error);
