// SPDX-License-Identifier: MIT
// Rules about combinations of options.
#pragma once

#include "cli/options/options.h"

// Rejects options that exclude each other, for any command.
bool options_check_conflicts(const Options *options, Error *error);

// Determines whether the picture goes to a file, and in which format, or to the window.  Rejects
// options of the other.
bool options_check_purpose(Options *options, Error *error);

// The same for clrt compare, whose picture is optional.
bool options_check_compare(Options *options, Error *error);

// The same for clrt merge, which always writes a file.
bool options_check_merge(Options *options, Error *error);
