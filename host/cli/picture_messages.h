// SPDX-License-Identifier: MIT
// The messages about a picture, besides reports.
#pragma once

#include "cli/picture_data.h"

// Prints a note if the error goal is so large that the user may have meant a percentage.
void picture_warn_of_goal(const Options *options);

// Prints a note if the parts have so few tiles that their times may differ much.
void picture_warn_of_few_tiles(const Options *options, const RenderSettings *settings);

// With --verbose, prints the path of a frame that begins and, with --resume, the number of tiles
// that were finished before.
void picture_print_beginning(const Picture *picture);

// On a terminal, prints the file's name, the picture's size and the seconds since picture->moment.
// Sets picture->moment to the current time.
void picture_print_end(Picture *picture);

// These functions fill error for a picture that misses its goal or is stopped, and return the exit
// status.
ExitCode picture_fail_goal(const Picture *picture, Error *error);
ExitCode picture_fail_stopped(const Picture *picture, Error *error);
