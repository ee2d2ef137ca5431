// SPDX-License-Identifier: MIT
// Rules about options that come together.
#pragma once

#include "cli/options/options.h"

// Rejects options that exclude each other, whatever they are for.
bool options_check_conflicts(const Options *options, Error *error);

// Decides whether the scene goes to a file, in which format, or to the window, and refuses options
// that are for the other.
bool options_check_purpose(Options *options, Error *error);

// The same of clrt compare, whose picture may be left out.
bool options_check_compare(Options *options, Error *error);

// The same of clrt merge, which writes to a file alone.
bool options_check_merge(Options *options, Error *error);
