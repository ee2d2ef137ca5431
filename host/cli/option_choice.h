// SPDX-License-Identifier: MIT
// The options whose values are among a few words.
#pragma once

#include "cli/option_reader.h"

ReadValue read_kernel, read_nodes, read_lanes, read_precision, read_bvh, read_specialize,
    read_encode, read_bad_geometry, read_list_devices;
