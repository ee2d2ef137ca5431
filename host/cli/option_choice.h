// SPDX-License-Identifier: MIT
// The options whose values are among a few words.
#pragma once

#include "cli/options.h"

// Takes an option's value; false where it is not understood.
typedef bool ReadValue(Options *options, const char *value, Error *error);

ReadValue read_kernel, read_nodes, read_lanes, read_precision, read_bvh, read_specialize,
    read_encode, read_bad_geometry;
